// The files of the modules that a program in the page may import, or that these need.

export const FILES = [
  "_clock.py", "_dialect.py", "_math.py", "_random.py", "_run.py", "_start.py", "_text.py", "_time.py",
  "__future__.py", "genpy.py", "geometry_msgs/msg.py", "nav_msgs/msg.py", "numbers.py", "rospy/__init__.py",
  "rospy/core.py", "rospy/exceptions.py", "rospy/logs.py", "rospy/robot.py", "rospy/timer.py", "rospy/topics.py",
  "sensor_msgs/msg.py", "std_msgs/msg.py", "typing.py",
];
