"""What the cockpit says to a person, most often why it refuses something: a code with arguments, and a sentence."""

from jetbot.sentence import Sentence, row

NOTICES = {
    # Who has no other name
    "pupil": "pupil {number}",
    "teacher": "teacher {number}",
    # Driving
    "own_robot_only": "With your code, you can drive only {robot}.",
    "interrupted": "The cockpit was interrupted. Let go, then drive again.",
    "no_command": "No command for {seconds} s. Let go, then drive again.",
    "let_go": "Let go, then drive again.",
    "driven": "{driver} drives {robot}.",
    "taken": "Your teacher has taken {robot}. Wait until a teacher presses Go on.",
    "no_master": "The ROS master does not answer.",
    "ended": "{robot} has ended.",
    "no_answer": "{robot} does not answer.",
    "all_stopped": "Emergency stop: it must be released first.",
    "stopped": "{robot}: its own emergency stop must be released first.",
    "put_back": "{robot} was put back to its start.",
    # What only teachers may do
    "teacher_take": "Only a teacher can take a robot.",
    "teacher_go_on": "Only a teacher lets robots go on.",
    "teacher_reset": "Only a teacher can put robots back.",
    "teacher_stops_one": "Only a teacher can stop a single robot. You can stop all.",
    "teacher_releases_one": "Only a teacher can release a single robot.",
    "teacher_releases": "Only a teacher can release this stop.",
    "not_stopped": "The emergency stop is not engaged.",
    "others_stopped": "Release {robots} in the list of robots. No other robot is stopped.",
    "teacher_codes": "Only a teacher can see the codes.",
    "teacher_new_code": "Only a teacher can replace a code.",
    "teacher_offer": "Only a teacher chooses the tasks.",
    "teacher_cameras": "Only a teacher switches the cameras.",
    "teacher_pupil": "Only a teacher names the pupils.",
    # Simulated robots and their tasks
    "not_reset": "The simulator does not answer: {robots}.",
    "real_not_reset": "Only simulated robots can be put back.",
    "real_not_judged": "Only simulated robots can be judged.",
    "judged_elsewhere": "A judge in a terminal already judges {robot}. When it has ended, press Judge me again.",
    "judge_driven": "{driver} drives {robot}. Press Judge me again when {robot} is free.",
    "judge_interrupted": "The cockpit was interrupted. Press Judge me again.",
    "no_judge": "No judge has this task now. Choose another one.",
    "task_off": "Your teacher has not switched this task on.",
    # Pictures
    "cameras_off": "Your teacher has switched the cameras off.",
    "own_camera_only": "With your code, you see only through {robot}'s camera.",
    "driver_collects": "Only who drives {robot} collects its pictures. Drive it first.",
    "no_picture": "There is no picture.",
    "no_pictures_kept": "This cockpit keeps no pictures.",
    "pictures_busy": "The disk is busy: wait until the number changes.",
    "free_full": "There are {count} pictures of Free already.",
    "blocked_full": "There are {count} pictures of Blocked already.",
    "picture_not_kept": "The picture was not kept: {problem} ({file})",
    # Programs, and the class
    "gone": "This program is not there any more.",
    "other_class": "This program belongs to another class.",
    "too_large": "This program is too large to be kept here: {kilobytes} kB at most. Save it as a file.",
    "no_program": "This is not a program.",
    "full": "There is no room for more: delete a program. A robot has {count} programs at most, and 1 MB in all.",
    "own_programs_only": "With your code, you see only the programs of your own robot.",
    "disk_busy": "The disk of the cockpit's computer is busy.",
    "disk": "The cockpit's computer could not keep it: {problem}.",
    "class_read_only": "{folder} is on a disk that is read-only: nothing of this class is kept.",
    "class_not_kept": "The class cannot be kept: {problem}. The cockpit tries again.",
    "class_kept_again": "The class is kept again.",
    "no_code": "There is no such code.",
    # A class's robots, at its hub
    "from_robot": "{robot}: {sentence}",
    "no_link": "No connection to {address}.",
    "wrong_key": "{robot} has another key than this class's.",
    "forged": "What answers at {address} pretends to be {robot}.",
    "relayed": "What answers at {address} passes on what {robot} says: enter the robot's own address.",
    "other_fleet": "The robot at {address} is of another class.",
    "twice": "Two robots are called {robot}: {address} and {other}. Give one another name.",
    "too_much": "{robot} sends too much: its connection was closed.",
}

Notice = Sentence  # of NOTICES


def say(code: str, **arguments: object) -> Notice:
    """Return a Notice."""
    return row(NOTICES, code, **arguments)
