"""Random numbers of a seed."""

import random

for seed in (0, 1, 7, -5, 2 ** 40, 2 ** 100 + 17):
    random.seed(seed)
    for k in range(4):
        print(random.random(), random.randint(1, 6), random.uniform(-1, 1), random.choice("abcdef"), random.getrandbits(70))
    print(round(random.gauss(0, 1), 9), round(random.gauss(0, 1), 9), round(random.normalvariate(1, 2), 9), round(random.triangular(0, 5, 2), 9), round(random.expovariate(2), 9))
    items = list(range(20))
    random.shuffle(items)
    print(items, random.sample(items, 3), random.sample(range(1000), 7), random.choices("abc", k=5), random.choices([1, 2, 3], weights=[1, 5, 2], k=5))
    print(random.randrange(0, 100, 7), random.randrange(9), random.sample(items, 20))
dice = random.Random(3)
print(dice.randint(1, 6), dice.random())
print([random.randint(0, 9) for _ in range(700)])
random.choice([])
