"""rospy's exceptions."""


class ROSException(Exception):
    pass


class ROSSerializationException(ROSException):
    pass


class ROSInitException(ROSException):
    pass


class ROSInterruptException(ROSException):
    pass


class ROSTimeMovedBackwardsException(ROSInterruptException):
    pass


class ROSInternalException(Exception):
    pass
