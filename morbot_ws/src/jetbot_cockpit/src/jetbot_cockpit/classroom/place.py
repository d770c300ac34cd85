"""Where classes are kept, and what they may be called."""

import re

from jetbot.kinds import Kind

FOLDER = "~/.ros/morbot_classes"
OWNER_ONLY = 0o700   # codes and keys are secrets
CLASS_NAME = Kind(lambda value: isinstance(value, str) and bool(re.fullmatch("[A-Za-z0-9_-]{0,20}", value)),
                  "letters, digits, _ and -, 20 at most")
