"""What people write who come from another language, and how RAPID writes it."""

from typing import Final

from rapidgen.rapid.syntax.source import Source

_CHARACTERS: Final = {
    "'": 'a string stands in double quotes: "..."',
    "&": "RAPID writes AND",
    "|": "RAPID writes OR",
    "~": "RAPID writes NOT",
    "^": "RAPID writes Pow(a, b)",
    "#": "a comment begins with `!`",
}
UNEQUAL: Final = "`!` begins a comment: RAPID's unequal is `<>`"
_STEPS: Final = {"+": "Incr a;", "-": "Decr a;"}


def foreign_syntax_help(source: Source, at: int) -> str:
    """The mend for what was meant at token `at`; "" where nothing of that kind is seen."""
    tokens = source.tokens
    current, before = _token(source, at), _token(source, at - 1)
    if current in _CHARACTERS:
        return _CHARACTERS[current]
    if current == "/" and at + 1 < len(tokens) and tokens[at + 1] in "/*" and _touches(source, at):
        return "a comment begins with `!`, on each of its lines"
    if current == "=" and _touches(source, at - 1):
        if before == "=":
            return "RAPID compares with one `=`, and assigns with `:=`"
        if before in ("+", "-", "*", "/"):
            return f"RAPID has no `{before}=`: write a := a {before} ...;"
    if before in _STEPS and _token(source, at - 2) == before and _touches(source, at - 2):
        return f"RAPID writes {_STEPS[before]}"
    if at > 0 and followed_by_unequal(source, at - 1):
        return UNEQUAL
    return ""


def followed_by_unequal(source: Source, at: int) -> bool:
    """Whether `!=` stands behind token `at`, and is no line of a drawing."""
    gap = source.gaps[at].lstrip()
    return gap.startswith("!=") and not gap.startswith("!==")


def second_if(source: Source, at: int) -> bool:
    """Whether the IF at token `at` was probably meant for an ELSEIF."""
    return (
        _token(source, at).upper() == "IF"
        and _token(source, at - 1).upper() == "ELSE"
        and source.line(at) == source.line(at - 1)
    )


def _token(source: Source, at: int) -> str:
    return source.tokens[at] if 0 <= at < len(source.tokens) else ""


def _touches(source: Source, at: int) -> bool:
    """Whether nothing stands between token `at` and the next one."""
    return at >= 0 and not source.gaps[at]
