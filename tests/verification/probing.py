"""A probe as an operator runs it: after a stop he goes on with the next question."""

import re


def asked(text):
    """The switches that a probe's module asks about."""
    return tuple(dict.fromkeys(re.findall(r'"(?:! If the program stops now: )?(\w+)=\w+"', text)))


def answers(text, path, run):
    """What the module says in the end; it is put into the file `path` for each run.

    `run(path)` gives the lines on the pendant, and whether an error stopped the program.
    """
    failures = []
    while True:
        path.write_text(text, encoding="ascii")
        lines, stopped = run(path)
        failures += lines
        if not stopped:
            return [line for line in failures if not line.startswith("!")]
        assert lines[-1].startswith("! If the program stops now: ")
        failures.append(lines[-1].rpartition(": ")[2])
        (asking,) = re.findall(rf'PROC (\w+)\(\)(?:(?!PROC).)*"{lines[-1]}"', text, re.DOTALL)
        # Another main, without what has been asked.
        head, main, remaining = text.partition("    PROC main()\n")
        done, _, left = remaining.partition(f"        {asking};\n")
        done = re.sub(r"^        (?:ask|tell)_\w+;\n", "", done, flags=re.MULTILINE)
        text = head + main + done + left
