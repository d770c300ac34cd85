"""Python's random, with its generator: the same whole number as a seed gives the same numbers as on a computer."""

from math import ceil, cos, exp, log, pi, sin, sqrt
from time import time

WORDS, MIDDLE = 624, 397  # of the Mersenne Twister MT19937 (Matsumoto and Nishimura, 1998)
MASK = 0xFFFFFFFF


class Random:
    def __init__(self, x=None):
        self.seed(x)

    def seed(self, a=None, version=2):
        self._next_gauss = None
        number = int(time() * 1e6) if a is None else _number(a)
        words = [number >> shift & MASK for shift in range(0, max(1, _bits(number)), 32)]
        state = [19650218]
        for i in range(1, WORDS):
            state.append(1812433253 * (state[-1] ^ state[-1] >> 30) + i & MASK)
        rounds = max(WORDS, len(words))
        for k in range(rounds):
            j = k % len(words)
            _mix(state, 1 + k % (WORDS - 1), 1664525, words[j] + j)
        for k in range(rounds, rounds + WORDS - 1):
            i = 1 + k % (WORDS - 1)
            _mix(state, i, 1566083941, -i)
        state[0] = 0x80000000
        self._state, self._at = state, WORDS

    def _word(self):
        """Return the next 32 random bits."""
        if self._at == WORDS:
            _twist(self._state)
            self._at = 0
        word = self._state[self._at]
        self._at += 1
        word ^= word >> 11
        word ^= word << 7 & 0x9D2C5680
        word ^= word << 15 & 0xEFC60000
        return word ^ word >> 18

    def random(self):
        high = self._word() >> 5
        return (high * 67108864 + (self._word() >> 6)) / 9007199254740992

    def getrandbits(self, k):
        number = 0
        for shift in range(0, k, 32):
            number |= self._word() >> max(0, 32 - (k - shift)) << shift
        return number

    def _below(self, n):
        bits, number = _bits(n), n
        while number >= n:
            number = self.getrandbits(bits)
        return number

    def randrange(self, start, stop=None, step=1):
        start, stop = (0, start) if stop is None else (start, stop)
        count = (stop - start + step + (-1 if step > 0 else 1)) // step
        if count <= 0:
            raise ValueError(f"empty range for randrange() ({start}, {stop}, {step})")
        return start + step * self._below(count)

    def randint(self, a, b):
        return self.randrange(a, b + 1)

    def uniform(self, a, b):
        return a + (b - a) * self.random()

    def choice(self, seq):
        if not len(seq):
            raise IndexError("Cannot choose from an empty sequence")
        return seq[self._below(len(seq))]

    def shuffle(self, x):
        for i in range(len(x) - 1, 0, -1):
            j = self._below(i + 1)
            x[i], x[j] = x[j], x[i]

    def sample(self, population, k):
        """Return k items of a sequence, each at most once."""
        n = len(population)
        if not 0 <= k <= n:
            raise ValueError("Sample larger than population or is negative")
        if n > 21 + (4 ** ceil(log(k * 3) / log(4)) if k > 5 else 0):
            return self._of_many(population, n, k)
        left, chosen = list(population), []
        for i in range(k):
            j = self._below(n - i)
            chosen.append(left[j])
            left[j] = left[n - i - 1]
        return chosen

    def _of_many(self, population, n, k):
        places = []
        while len(places) < k:
            place = self._below(n)
            if place not in places:
                places.append(place)
        return [population[place] for place in places]

    def choices(self, population, weights=None, *, cum_weights=None, k=1):
        """Return k items, any of them more than once; with weights, some more often than others."""
        n = len(population)
        if weights is None and cum_weights is None:
            return [population[int(self.random() * n)] for _ in range(k)]
        sums = cum_weights or [sum(weights[:i + 1]) for i in range(n)]
        marks = [self.random() * sums[-1] for _ in range(k)]
        return [population[sum([each <= mark for each in sums[:-1]])] for mark in marks]

    def gauss(self, mu=0.0, sigma=1.0):
        z, self._next_gauss = self._next_gauss, None
        if z is None:
            angle, radius = 2 * pi * self.random(), sqrt(-2 * log(1 - self.random()))
            z, self._next_gauss = cos(angle) * radius, sin(angle) * radius
        return mu + z * sigma

    def normalvariate(self, mu=0.0, sigma=1.0):
        while True:
            u1, u2 = self.random(), 1 - self.random()
            z = 4 * exp(-0.5) / sqrt(2) * (u1 - 0.5) / u2
            if z * z / 4 <= -log(u2):
                return mu + z * sigma

    def triangular(self, low=0.0, high=1.0, mode=None):
        u, c = self.random(), 0.5 if mode is None else (mode - low) / (high - low)
        if u > c:
            u, c, low, high = 1 - u, 1 - c, high, low
        return low + (high - low) * sqrt(u * c)

    def expovariate(self, lambd=1.0):
        return -log(1 - self.random()) / lambd


def _number(seed):
    """Return the whole number that stands for a seed."""
    return abs(seed if isinstance(seed, int) else hash(seed))


def _bits(number):
    bits = 0
    while number >> bits:
        bits += 1
    return bits


def _mix(state, i, factor, summand):
    """Mix what is given into word i of the state."""
    before = state[i - 1]
    state[i] = (state[i] ^ (before ^ before >> 30) * factor) + summand & MASK
    if i == WORDS - 1:
        state[0] = state[i]


def _twist(state):
    for i in range(WORDS):
        word = state[i] & 0x80000000 | state[(i + 1) % WORDS] & 0x7FFFFFFF
        state[i] = state[(i + MIDDLE) % WORDS] ^ word >> 1 ^ (0x9908B0DF if word & 1 else 0)


_shared = Random()
globals().update({name: getattr(_shared, name) for name in dir(Random) if name[0] != "_"})
