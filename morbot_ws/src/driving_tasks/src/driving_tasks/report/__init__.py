"""What people get of a judged drive: marks in tables, sentences and topics, and a picture."""
