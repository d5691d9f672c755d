# SPDX-License-Identifier: BSD-3-Clause
"""Generated parts of hand-written Markdown pages."""


def table(head, rows):
    """A Markdown table; the first column is text, the others are numbers."""
    lines = ["| " + " | ".join(head) + " |", "|---|" + "---:|" * (len(head) - 1)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def replace_part(path, name, text):
    """Replaces what stands between <!-- NAME:begin ... --> and <!-- NAME:end --> in a file."""
    page = path.read_text(encoding="utf-8")
    begin = page.find(f"<!-- {name}:begin")
    begin_end = page.find("-->", begin)
    end = page.find(f"<!-- {name}:end -->")
    if begin < 0 or begin_end < 0 or end < begin_end:
        raise RuntimeError(f"{path}: has no lines '<!-- {name}:begin -->' and '<!-- {name}:end -->' in this order")
    begin_end += len("-->")
    path.write_text(f"{page[:begin_end]}\n{text.strip()}\n\n{page[end:]}", encoding="utf-8")


def seeds(text):
    """Numbers and spans: "11-15" or "1,4". @throws ValueError"""
    numbers = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        numbers += range(int(first), int(last or first) + 1)
    if not numbers:
        raise ValueError(f"{text}: no seeds")
    return numbers


def name_seeds(numbers):
    """How a page calls them."""
    if len(numbers) == 1:
        return f"seed {numbers[0]}"
    if numbers == list(range(numbers[0], numbers[-1] + 1)):
        return f"seeds {numbers[0]} to {numbers[-1]}"
    return "seeds " + ", ".join(map(str, numbers))
