"""Publishers and subscribers: the robot's topics, and the program's own."""

import _clock
from _start import NAMESPACE, NotHeard, NotHere, drive
from genpy import Duration, Message, SerializationError, received

from .core import is_initialized, is_shutdown, resolve_name
from .exceptions import ROSException, ROSInterruptException, ROSSerializationException
from .robot import TOPICS, senses

CMD_VEL = NAMESPACE + "cmd_vel"
INTERVAL = 0.1  # s after which the robot reports the same again
SOON = 0.01  # s in which a message arrives that the program publishes itself
GRACE = 1  # s in which a program may begin to publish what it subscribes to, and the other way round

_of_robot = {NAMESPACE + name: row for name, row in TOPICS.items()}
_types = {name: row[0] for name, row in _of_robot.items()}
_types[CMD_VEL] = "geometry_msgs/Twist"
_publishers = {}  # by topic: a list, empty once all are unregistered
_subscribers = {}
_latched = {}  # the last message


class _Topic:
    def __init__(self, name, data_class, others):
        if not name or not isinstance(name, str):
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if not isinstance(data_class, type):
            raise ValueError(f"data_class [{data_class}] is not a class")
        if not issubclass(data_class, Message):
            raise ValueError("data_class [type] is not a message data class")
        if name.startswith("~") and not is_initialized():
            raise ValueError("~name topics cannot be created before init_node() has been called")
        self.name = self.resolved_name = resolve_name(name)
        self.data_class, self.type, self._others = data_class, data_class._type, others
        expected = _types.setdefault(self.name, self.type)
        if expected != self.type:
            raise TypeError(f"{name} carries {expected}, not {self.type}")
        others.setdefault(self.name, []).append(self)

    def unregister(self):
        if self.resolved_name:
            self._others[self.name].remove(self)
            self.resolved_name = self.type = self.data_class = None


class Publisher(_Topic):
    def __init__(self, name, data_class, subscriber_listener=None, tcp_nodelay=False, latch=False, headers=None,
                 queue_size=None):
        super().__init__(name, data_class, _publishers)
        self._latch, self._since = latch, _clock.seconds()
        if self.name.endswith("/cmd_vel") and self.name != CMD_VEL:
            raise NotHeard(self.name)  # another robot's

    def get_num_connections(self):
        """Return whether anybody hears; raise NotHeard once nobody has for too long: the program may wait for it."""
        heard = self.name == CMD_VEL or bool(_subscribers.get(self.name))
        if not heard and _clock.seconds() - self._since > GRACE:
            raise NotHeard(self.name)
        return int(heard)

    def publish(self, *args, **kwds):
        if not self.resolved_name:
            raise ROSException("publish() to an unregistered() handle")
        if not is_initialized():
            raise ROSException("ROS node has not been initialized yet. Please call init_node() first")
        message = self._message(args, kwds)
        try:
            sent = received(message)
        except SerializationError as error:
            raise ROSSerializationException(str(error)) from None
        if is_shutdown():
            return
        if self._latch:
            _latched[self.name] = sent
        for subscriber in _subscribers.get(self.name, ()):
            subscriber.receive(received(sent))
        if self.name == CMD_VEL:
            drive(sent.linear.x, sent.angular.z)

    def _message(self, args, kwds):
        if args and kwds:
            raise TypeError("publish() can be called with arguments or keywords, but not both.")
        if len(args) == 1 and isinstance(args[0], Message):
            given, kinds = args[0]._type, self.data_class._slot_types
            if given == self.type:
                return args[0]
            if not kinds or given != kinds[0]:
                raise TypeError(f"expected [{kinds[0] if kinds else ''}] but got [{given}]")
        return self.data_class(*args, **kwds)


class Subscriber(_Topic):
    def __init__(self, name, data_class, callback=None, callback_args=None, queue_size=None, buff_size=65536,
                 tcp_nodelay=False):
        super().__init__(name, data_class, _subscribers)
        self.callback, self.callback_args, self._size = callback, callback_args, queue_size
        self._queue, self._runs, self._since = [], False, _clock.seconds()
        self._seen, self._seen_at = None, -INTERVAL  # of what the robot reports
        if self.name in _latched:
            self.receive(received(_latched[self.name]))
        _clock.add(self)

    def get_num_connections(self):
        return int(self.name in _of_robot or bool(_publishers.get(self.name)))

    def unregister(self):
        super().unregister()
        if self in _clock.tasks:
            _clock.tasks.remove(self)

    def receive(self, message):
        self._queue.append(message)
        if self._size:
            del self._queue[:-self._size]

    def patience(self):
        """Return how long this can wait, in s."""
        return SOON if self._queue and not self._runs else INTERVAL

    def run(self):
        """Run the callback for each message that has come; meanwhile, no other call of it begins."""
        if self._runs:
            return
        self._sense()
        messages, self._queue, self._runs = self._queue, [], True
        try:
            for message in messages:
                self._call(message)
        finally:
            self._runs = False

    def _call(self, message):
        if self.callback is not None and self.callback_args is None:
            self.callback(message)
        elif self.callback is not None:
            self.callback(message, self.callback_args)

    def _sense(self):
        """Receive what the robot reports: each new value, and the same one ten times a second."""
        if self.name not in _of_robot:
            return self._check_published()
        _, sense, fill = _of_robot[self.name]
        known, now = senses(), _clock.seconds()
        if known.get(sense) is None or known == self._seen and now - self._seen_at < INTERVAL - 0.01:
            return None
        self._seen, self._seen_at = known, now
        message = self.data_class()
        fill(message, known)
        return self.receive(message)

    def _check_published(self):
        if self.name not in _publishers and self.name != CMD_VEL and _clock.seconds() - self._since > GRACE:
            raise NotHere(self.name)


def wait_for_message(topic, topic_type, timeout=None):
    """Return the next message. timeout: in s, or a Duration; raise ROSException when it has passed."""
    messages = []
    subscriber = Subscriber(topic, topic_type, messages.append)
    end = _clock.seconds() + (timeout.to_sec() if isinstance(timeout, Duration) else timeout or 0)
    try:
        while not messages and not is_shutdown():
            _clock.turn(SOON)
            if not messages and timeout is not None and _clock.seconds() >= end:
                raise ROSException(f"timeout exceeded while waiting for message on topic {topic}")
    finally:
        subscriber.unregister()
    if not messages:
        raise ROSInterruptException("rospy shutdown")
    return messages[0]
