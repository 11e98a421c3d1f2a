"""First words of some random streams, for crates/core/tests/core/streams/reference.rs: SplitMix64 (Steele, Lea, Flood 2014) and PCG XSL RR
128/64 (O'Neill 2014) written from the publications. Python 3.11, no packages."""

WORD, WIDE = (1 << 64) - 1, (1 << 128) - 1
MULTIPLIER = 0x2360ED051FC65DA44385DF649FCCF645
STREAMS = [(7, 30, 5), (1, 2, 0), (3, 0x535455_4459, 6, 2, 9), (7, 901)]


def mixed(word):
    z = (word + 0x9E3779B97F4A7C15) & WORD
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & WORD
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & WORD
    return z ^ (z >> 31)


def words(numbers, count):
    """Words of the stream of a seed, the number of a purpose, and further numbers."""
    hashed = mixed(numbers[0])
    for number in numbers[1:]:
        hashed = mixed(hashed ^ mixed(number))
    increment = (mixed(hashed ^ numbers[-1]) << 1 | 1) & WIDE
    start = hashed << 64 | mixed(~hashed & WORD)
    state = ((start + increment) * MULTIPLIER + increment) & WIDE
    for _ in range(count):
        state = (state * MULTIPLIER + increment) & WIDE
        folded, turn = (state >> 64 ^ state) & WORD, state >> 122
        yield (folded >> turn | folded << (64 - turn)) & WORD


for numbers in STREAMS:
    print(*numbers, *(f"0x{word:016x}" for word in words(numbers, 3)))
