"""How fast a client may send. No clock here."""


class TokenBucket:
    """Allows ``rate`` messages or bytes per second, and after a pause of the network ``burst`` at once."""

    def __init__(self, rate: float, burst: int, now: float):
        self._rate, self._burst = rate, burst
        self._tokens, self._filled = float(burst), now

    def take(self, now: float, amount: int = 1) -> bool:
        """Count so many; return whether they are within the limit. now: in s, never less than before."""
        self._tokens = min(self._burst, self._tokens + (now - self._filled) * self._rate)
        self._filled = now
        if self._tokens < amount:
            return False
        self._tokens -= amount
        return True
