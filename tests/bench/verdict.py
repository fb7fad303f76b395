"""Says of delays measured beside a peer whether they are behind it: only where the peer agrees with itself."""

AGREEMENT = 1.1  # two series of the peer may differ by so much
TARGET = 1.1  # times the peer


def judge(first, ours, second):
    """The text of a cell: `first` and `second` are the peer's figure in two series, before and after each run of ours."""
    low, high = sorted((first, second))
    if not low > 0 or high > AGREEMENT * low:
        return f"no verdict ({first:.1f}, {second:.1f})"
    ratio = ours / ((first + second) / 2)
    return f"{ratio:.2f} " + ("reached" if ratio <= TARGET else "missed")
