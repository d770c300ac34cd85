"""What two programs must agree about is stated once, in jetbot_ros.contract."""

import ast

from test_layers import FILES

from jetbot_ros import contract

TOPICS = {value for name, value in vars(contract).items() if name.isupper() and "/" in str(value)}


def test_no_program_writes_a_shared_topic_by_itself():
    assert contract.STOP in TOPICS and contract.STATE in TOPICS
    for _, file in FILES:
        texts = [node.value for node in ast.walk(ast.parse(file.read_text()))
                 if isinstance(node, ast.Constant) and isinstance(node.value, str)]
        written = {topic for topic in TOPICS for text in texts if topic in text}
        assert not written or file.name == "contract.py", f"{file} writes {written}"
