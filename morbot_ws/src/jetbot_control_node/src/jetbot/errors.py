"""What can go wrong, as one small tree: every error is a JetbotError and a builtin error too."""


class JetbotError(Exception):
    """A sentence for the user: what is wrong (``reason``) and what to do about it (``advice``)."""

    def __init__(self, reason, advice=""):
        super().__init__(reason, advice)
        self.reason = reason
        self.advice = advice

    def __str__(self):
        sentence = f"{self.reason[0].upper()}{self.reason[1:]}."
        return f"{sentence} {self.advice}" if self.advice else sentence


class InvalidValue(JetbotError, ValueError):
    """A speed, an option or a parameter that cannot be used."""


class BusError(JetbotError, OSError):
    """The motor board cannot be reached; ``errno`` tells why, as the operating system does."""

    def __init__(self, reason, advice="", errno=None):
        super().__init__(reason, advice)
        self.errno, self.strerror = errno, reason
