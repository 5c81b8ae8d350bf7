"""Text to tokens: decoding, the %%% header, and the kind of each token.

Sources: [K §2.1-2.10] for the lexical elements; hexadecimal, octal and binary numbers are newer
than K and known from public code. Each distinct spelling is classified once.
"""

import re
from dataclasses import dataclass, field, replace
from typing import Final

from rapidgen.rapid.syntax.source import HEADER, LEAD, TOKENS, Source

NAME: Final = "a name"
NUMBER: Final = "a number"
STRING: Final = "a string"
HOLDER: Final = "a placeholder"
EOF: Final = "the end of the file"
BAD_CHARACTER: Final = "a character outside RAPID"
BAD_NAME: Final = "a name with letters outside Latin-1"
BAD_NUMBER: Final = "a malformed number"
BAD_RADIX: Final = "a number with a prefix"
BAD_ESCAPE: Final = "a string with a bad escape"
UNTERMINATED: Final = "a string without its closing quote"

MAX_NAME: Final = 32
"""Characters of an identifier [K §2.3]."""
_MAX_DIGITS: Final = 300
"""Digits of whole numbers stored as int: a float covers all of them."""

KEYWORDS: Final = frozenset(
    """ALIAS AND BACKWARD CASE CONNECT CONST DEFAULT DIV DO ELSE ELSEIF ENDFOR ENDFUNC ENDIF
    ENDMODULE ENDPROC ENDRECORD ENDTEST ENDTRAP ENDWHILE ERROR EXIT FALSE FOR FROM FUNC GOTO IF
    INOUT LOCAL MOD MODULE NOSTEPIN NOT NOVIEW OR PERS PROC RAISE READONLY RECORD RETRY RETURN
    STEP SYSMODULE TASK TEST THEN TO TRAP TRUE TRYNEXT UNDO VAR VIEWONLY WHILE WITH XOR""".split()  # noqa: SIM905  # reads better
)
"""All 58 reserved words [K §2.4; TASK from K §2.18]."""

PUNCTUATION: Final = frozenset("{}()[],.=<>+-*/:;\\?%|") | {":=", "<>", "<=", ">="}

_LETTERS: Final = r"A-Za-z\u00c0-\u00d6\u00d8-\u00f6\u00f8-\u00ff"
_PROPER_NAME: Final = re.compile(rf"[{_LETTERS}][{_LETTERS}0-9_]*")
_RADIX: Final = re.compile(r"0(?:[xX][0-9A-Fa-f]+|[oO][0-7]+|[bB][01]+)")
_ESCAPE: Final = re.compile(r'""|\\(?:\\|[0-9A-Fa-f]{2})')
# Of the three kinds of piece one at most fits at any place, so there is one way to read a text.
_BAD_ESCAPE: Final = re.compile(r"(?:[^\\]|\\\\|\\[0-9A-Fa-f]{2})*\\(?!\\|[0-9A-Fa-f]{2})")


class Kinds(dict[str, str]):
    """Spelling to kind: the upper-case keyword, or the sign itself."""

    def __missing__(self, text: str) -> str:
        kind = self[text] = _classify(text)
        return kind


def _classify(text: str) -> str:
    head = text[0]
    if head.isalpha() or head == "_":
        if text.isascii():
            upper = text.upper()
            if upper in KEYWORDS:
                return upper
            return BAD_NAME if head == "_" else NAME
        return NAME if _PROPER_NAME.fullmatch(text) else BAD_NAME
    if head in "0123456789" or (head == "." and len(text) > 1):
        if _RADIX.fullmatch(text):
            return BAD_RADIX
        return NUMBER if _is_number(text) else BAD_NUMBER
    if head == '"':
        if len(text) == 1 or text[-1] != '"' or text.count('"') % 2:
            return UNTERMINATED
        return BAD_ESCAPE if "\\" in text and _BAD_ESCAPE.match(text[1:-1]) else STRING
    if head == "<" and len(text) > 2:
        return HOLDER
    return text if text in PUNCTUATION else BAD_CHARACTER


def _is_number(text: str) -> bool:
    # Python takes more than RAPID does only where letters or underscores are in play.
    try:
        float(text)
    except ValueError:
        return False
    return "_" not in text


@dataclass(frozen=True, slots=True)
class Tokens:
    """A tokenised source with kinds and end marks for look-ahead."""

    source: Source
    kinds: list[str]
    spellings: Kinds
    blanks: list[int] = field(default_factory=list)
    """Offsets of invisible characters that RAPID does not have; they are read as blanks."""
    unread: str = ""
    """The text with them."""


def decode(data: bytes, otherwise: str = "latin-1") -> tuple[str, str]:
    """Return the text of a file: UTF-8 if valid, else `otherwise` if that fits, else Latin-1.

    UTF-8 may have a BOM.
    """
    known = "utf-8-sig" if data.startswith(b"\xef\xbb\xbf") else "utf-8"
    for encoding in (known, otherwise):
        try:
            return data.decode(encoding), encoding
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1"), "latin-1"


def tokenize(text: str, path: str, encoding: str, *, radix: bool) -> Tokens:
    """Return all tokens of `text`; `radix` permits 0x, 0o and 0b."""
    header = HEADER.match(text)
    lead = LEAD.match(text, header.end() if header else 0)
    start = lead.end() if lead else 0
    result: list[str] = TOKENS.findall(text, start)
    while result and not result[-1]:
        result.pop()
    source = Source(text, path, encoding, text[:start], result)
    spellings = Kinds()
    kinds = list(map(spellings.__getitem__, source.tokens))
    unseen = {t for t, k in spellings.items() if k is BAD_CHARACTER and not t.isprintable()}
    if unseen:
        places = [at for at, t in zip(source.starts, result, strict=True) if t in unseen]
        letters = list(text)
        for at in places:
            letters[at] = " "
        again = tokenize("".join(letters), path, encoding, radix=radix)
        return replace(again, blanks=places, unread=text)
    if radix and BAD_RADIX in spellings.values():
        kinds = [NUMBER if kind is BAD_RADIX else kind for kind in kinds]
    kinds += (EOF, EOF, EOF, EOF)
    return Tokens(source, kinds, spellings)


def number_value(text: str) -> float:
    """Return the value of a number, an int without point and exponent.

    It is infinite beyond double precision.
    """
    if text.isdigit():
        return int(text) if len(text) <= _MAX_DIGITS else float(text)
    if len(text) > 1 and text[1] in "xXoObB":
        value = int(text, 0)
        return value if value < 10**_MAX_DIGITS else float("inf")
    return float(text)


def string_value(text: str) -> str:
    """Return the value of a string token, one code point per byte.

    Quotes are removed and escapes resolved.
    """
    inner = text[1:-1]
    if "\\" in inner or '"' in inner:
        inner = _ESCAPE.sub(_unescape, inner)
    if not inner.isascii() and any(c > "\xff" for c in inner):
        return inner.encode("utf-8", "surrogatepass").decode("latin-1")
    return inner


def _unescape(match: re.Match[str]) -> str:
    result = match.group()
    if result == '""':
        return '"'
    return "\\" if result == "\\\\" else chr(int(result[1:], 16))
