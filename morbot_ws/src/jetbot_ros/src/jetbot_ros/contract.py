"""The names and limits that two programs share. What else they agree about: state.py, and jetbot.kinematics."""

# Nodes, in whatever namespace
CONTROLLER = "jetbot_controller"
COCKPIT = "jetbot_cockpit"      # what a person drives with: it has priority over programs
SIMULATOR = "jetbot_simulator"
CLASS_JUDGE = "class_judge"     # judges robots on request

# Topics and services, below the robot's namespace
STATE = f"{CONTROLLER}/state"
WHEELS = f"{CONTROLLER}/wheels"
WHEELS_LABEL = "x, z, left, right"  # its four numbers: the command, and what the wheels get
OWN_STOP = f"{CONTROLLER}/emergency_stop"
RESET = f"{SIMULATOR}/reset"
GROUND_TRUTH, BODY, SET_WORLD = f"{SIMULATOR}/ground_truth", f"{SIMULATOR}/body", f"{SIMULATOR}/world"
WORLD = "world"                 # what is around the robot
TASK, TASK_COURSE = "task", "task_course"  # of a judge
DRIVER = "driver"               # who drives by the page

INTERRUPTIONS = {               # of a person's drive: a code, and a phrase
    "taken": "a teacher took the robot over",
    "put_back": "a teacher put the robot back to its start",
    "left": "the driver's page was closed, or lost its connection",
    "silent": "no command came from the driver's page for {seconds} s",
}

# Topics of all robots
STOP = "/emergency_stop"
JUDGE_TASKS, JUDGE_REQUESTS = "/judge_tasks", "/judge_requests"

COCKPIT_PORT = 8080  # TCP, the default one
MAX_NAME = 20        # characters of a person's name
