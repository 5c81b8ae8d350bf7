"""Syntax errors: reports and help for syntax of other languages."""

from collections.abc import Sequence
from typing import Final

from rapidgen.diagnostics import Diagnostic, Fix, Label, Span, error, replacement
from rapidgen.rapid.syntax import lexer
from rapidgen.rapid.syntax.source import Source

# -- Syntax of other languages ---------------------------------------------------------------------
#
# What people write who come from another language, and how RAPID writes it.


_CHARACTERS: Final = {
    "'": 'a string requires double quotes: "..."',
    "&": "RAPID writes AND",
    "|": "RAPID writes OR",
    "~": "RAPID writes NOT",
    "^": "RAPID writes Pow(a, b)",
    "#": "a comment begins with `!`",
}
UNEQUAL: Final = "`!` begins a comment: RAPID's unequal is `<>`"
_STEPS: Final = {"+": "Incr a;", "-": "Decr a;"}


def foreign_syntax_help(source: Source, at: int) -> str:
    """Return help for syntax of another language at token `at`.

    Returns "" for other errors.
    """
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
    """Return True if `!=` follows token `at`, outside a line of `=`."""
    gap = source.gaps[at].lstrip()
    return gap.startswith("!=") and not gap.startswith("!==")


def second_if(source: Source, at: int) -> bool:
    """Return True if the IF at token `at` was probably an ELSEIF."""
    return (
        _token(source, at).upper() == "IF"
        and _token(source, at - 1).upper() == "ELSE"
        and source.line(at) == source.line(at - 1)
    )


def _token(source: Source, at: int) -> str:
    return source.tokens[at] if 0 <= at < len(source.tokens) else ""


def _touches(source: Source, at: int) -> bool:
    """Return True if token `at` touches the next one."""
    return at >= 0 and not source.gaps[at]


# -- Reports ---------------------------------------------------------------------------------------
#
# Reports on wrong text: one function per diagnostic, and the parser's exceptions.


_LOOKED_BACK: Final = 2_000
"""Tokens in which an ELSE IF is looked for: texts may be long, and errors many."""
Block = tuple[str, int]
"""Keyword of an open block and the index of its token."""

CLOSER: Final = {
    "MODULE": "ENDMODULE",
    "RECORD": "ENDRECORD",
    "PROC": "ENDPROC",
    "FUNC": "ENDFUNC",
    "TRAP": "ENDTRAP",
    "IF": "ENDIF",
    "FOR": "ENDFOR",
    "WHILE": "ENDWHILE",
    "TEST": "ENDTEST",
}

_LEXICAL: Final = {
    lexer.BAD_CHARACTER: ("RG204", "this character has no meaning in RAPID", ""),
    lexer.BAD_NAME: (
        "RG204",
        "a name may only have letters of Latin-1",
        "rename it with letters A to Z, accented Latin letters, digits and _",
    ),
    lexer.BAD_NUMBER: (
        "RG205",
        "this is not a number",
        "numbers look like 3, 38., .27 or 2.5E-3, and a blank ends them",
    ),
    lexer.BAD_RADIX: (
        "RG205",
        "numbers with a prefix 0x, 0o or 0b are younger than this RobotWare",
        "write the value in decimal, or check with --robotware 6 or later",
    ),
    lexer.BAD_ESCAPE: (
        "RG206",
        "a backslash in a string starts a code of two hexadecimal digits",
        "write \\\\ for a backslash, and \\0A for a line feed",
    ),
    lexer.UNTERMINATED: (
        "RG207",
        "the closing quote is missing on this line",
        'a string ends on its own line; write "" for a quote inside it',
    ),
}


class SyntaxFault(Exception):
    """An unusable token; the nearest statement list catches it."""

    def __init__(self, at: int, expected: str, help: str = "") -> None:
        super().__init__(expected)
        self.at = at
        self.expected = expected
        self.help = help
        self.reported = False


class ParseAborted(Exception):
    """Ends the parse of a text beyond the limits or with too many errors."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


def place(source: Source, at: int) -> Span:
    """Return the place of token `at`, or of the end of the text."""
    if at < len(source.tokens):
        return source.span(at, at)
    line, column = source.position(len(source.text))
    return Span(source.path, line, column)


def describe_token(source: Source, kinds: Sequence[str], at: int) -> str:
    """Return the display name of a token."""
    if at >= len(source.tokens):
        return lexer.EOF
    text = source.tokens[at]
    displayed = text if len(text) <= 40 else text[:37] + "..."
    return (
        f"'{displayed}'"
        if len(text) > 1 or text.isascii()
        else f"'{displayed}' (U+{ord(text):04X})"
    )


def still_open(source: Source, blocks: Sequence[Block]) -> tuple[tuple[Label, ...], str]:
    """Return a label at the innermost open block.

    A note lists all open blocks.
    """
    if not blocks:
        return (), ""
    keyword, at = blocks[-1]
    labels = (Label(source.span(at, at), f"this {keyword} is still open"),)
    inner = list(reversed(blocks))
    listed = ", ".join(f"{k} (line {source.line(i)})" for k, i in inner[:5])
    return labels, f"open here: {listed}" + (", ..." if len(inner) > 5 else "")


def unexpected(
    source: Source,
    kinds: Sequence[str],
    at: int,
    expected: str,
    blocks: Sequence[Block],
    help: str = "",
) -> Diagnostic:
    """Report an unexpected token: the token, the expectation, open blocks."""
    span = place(source, at)
    lexical = _LEXICAL.get(kinds[at])
    if lexical:
        code, message, help_text = lexical
        help_text = help_text or foreign_syntax_help(source, at)
        return error(code, span, f"{message}: {describe_token(source, kinds, at)}", help_text)
    related, note = still_open(source, blocks)
    return error(
        "RG201",
        span,
        f"met {describe_token(source, kinds, at)}, expected {expected}",
        help or _help(source, kinds, at, expected),
        label=f"expected {expected}",
        notes=(note,) if note else (),
        related=related,
        fixes=_fixes(source, kinds, at, expected),
    )


def _fixes(source: Source, kinds: Sequence[str], at: int, expected: str) -> tuple[Fix, ...]:
    """Return corrections of frequent slips.

    They are safe where a text can have but one meaning: an assignment with `=`, a comparison with
    `==`, empty parentheses of a procedure call.
    """
    before = _token(source, at - 1)
    if kinds[at] == "=" and "':='" in expected:
        twice = _token(source, at + 1) == "=" and _touches(source, at)
        span = source.span(at, at + 1 if twice else at)
        return replacement("Change to ':='", span, ":=", is_safe=True)
    if kinds[at] == "=" and before == "=" and _touches(source, at - 1):
        return replacement("Change to '='", source.span(at - 1, at), "=", is_safe=True)
    if kinds[at] == ")" and before == "(" and expected == "an argument":
        return replacement("Remove the parentheses", source.span(at - 1, at), "", is_safe=True)
    starts_line = at > 0 and (at >= len(source.tokens) or source.line(at) > source.line(at - 1))
    if "';'" in expected and starts_line:
        end = source.span(at - 1, at - 1)
        place_after = Span(end.path, end.end_line, end.end_column, end.end_line, end.end_column)
        return replacement("Insert ';'", place_after, ";")
    return ()


def _help(source: Source, kinds: Sequence[str], at: int, expected: str) -> str:
    if kinds[at] == "=" and "':='" in expected:
        return "write `:=` where a value is given; `=` compares"
    meant = foreign_syntax_help(source, at)
    if meant:
        return meant
    begins = kinds[at] in (lexer.NAME, lexer.NUMBER, lexer.STRING, "[")
    if begins and "','" in expected and source.line(at) == source.line(at - 1):
        met = describe_token(source, kinds, at)
        return f"a ',' is missing between two arguments, perhaps before {met}"
    if "';'" in expected:
        return "a statement or declaration ends with ';': perhaps the one before has none"
    if kinds[at] == lexer.EOF:
        return f"write {expected} here"
    return f"write {expected} here, or remove this"


def unclosed(
    source: Source, kinds: Sequence[str], at: int, blocks: Sequence[Block], missing: int
) -> Diagnostic:
    """Report that token `at` closes an outer block.

    `missing` inner blocks are open.
    """
    inner = blocks[len(blocks) - missing :]
    closers = " and ".join(CLOSER[keyword] for keyword, _ in reversed(inner[-3:]))
    related, note = still_open(source, blocks)
    split = any(second_if(source, i) for i in range(max(inner[0][1], at - _LOOKED_BACK), at))
    return error(
        "RG202",
        place(source, at),
        f"met {describe_token(source, kinds, at)}, but {closers} is missing before it",
        f"add {closers} before this place"
        + ("; ELSE IF begins a second IF, ELSEIF is one word" if split else ""),
        label=f"expected {CLOSER[inner[-1][0]]}",
        notes=(note,),
        related=related,
        fixes=_closing(source, at, inner),
    )


def _closing(source: Source, at: int, inner: Sequence[Block]) -> tuple[Fix, ...]:
    """Return the fix that adds the missing ends, each indented like its block."""
    if at >= len(source.tokens) or source.line(at) == source.line(at - 1):
        return ()
    lines = []
    for keyword, opened in reversed(inner):
        line = source.line(opened)
        start = source.offset(line, 1)
        text = source.text[start : source.starts[opened]]
        indent = text[: len(text) - len(text.lstrip())]
        lines.append(f"{indent}{CLOSER[keyword]}\n")
    closers = " and ".join(CLOSER[keyword] for keyword, _ in reversed(inner))
    line = source.line(at)
    return replacement(f"Add {closers}", Span(source.path, line, 1, line, 1), "".join(lines))


def too_many(last: Diagnostic, limit: int) -> Diagnostic:
    """Report that the rest of a text was not checked."""
    return error(
        "RG214",
        last.span,
        f"more than {limit} errors: the rest of the text was not read",
        "correct the first ones and check again",
    )


def unmatched(
    source: Source,
    kinds: Sequence[str],
    at: int,
    expected: str,
    blocks: Sequence[Block],
    suspect: int,
) -> Diagnostic:
    """Report a token that ends or divides a block that is not open.

    `suspect` is a compact IF whose THEN may be missing, or -1.
    """
    related, note = still_open(source, blocks)
    if suspect >= 0:
        related = (Label(source.span(suspect, suspect), "is THEN missing after this condition?"),)
    return error(
        "RG203",
        place(source, at),
        f"met {describe_token(source, kinds, at)}, but no block that it belongs to is open here",
        "remove it, or add the statement that opens its block",
        label=f"expected {expected}",
        notes=(note,) if note else (),
        related=related,
    )
