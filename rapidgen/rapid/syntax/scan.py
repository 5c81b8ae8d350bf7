"""The regular expressions that cut RAPID text into tokens [K §2.1-2.10].

`TOKENS.findall` gives all tokens and nothing else, which is all that a parse needs; `TILES`
gives each token with what stands behind it, so that the pieces tile the text. Both use the
same token and the same blanks.
"""

import re
import sys
from typing import Final

_PLACEHOLDERS: Final = "TDN|DDN|RDN|PAR|ALT|DIM|SMT|VAR|EIT|CSE|EXP|ARG|ID"
# A blank has to stand between a number and a word [K §2.2], but programs of cells do without one
# before these words: `IF status = 1THEN`, in three of three authors, one saved a dozen times.
_GOING_ON: Final = r"(?i:THEN|DO|TO|STEP|AND|OR|XOR|MOD|DIV)\b"
# Behind blanks and comments stands a token or the end, whatever the text, so a repeat never has
# to give anything back; possessive (Python 3.11) it need not remember how to, and is faster.
_ANY: Final = "*+" if sys.version_info >= (3, 11) else "*"
# Loops over single classes, unrolled: nested repeats cost twice the time.
_TRIVIA: Final = rf"[ \t\r\n\f]{_ANY}(?:![^\r\n]{_ANY}[ \t\r\n\f]{_ANY}){_ANY}"
# The commonest first. What no alternative wants is a token of one character, so that any text
# is cut up; the parser says what is wrong with it.
_TOKEN: Final = (
    r"([,;()\[\]{}\\]"
    r"|[^\W\d]\w*"
    rf"|(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?:(?![\w.])|(?={_GOING_ON}))"
    r"|:="
    r'|"(?:[^"\r\n]|"")*"'
    rf"|<(?i:{_PLACEHOLDERS})>"
    r"|<>|<=|>="
    r"|[0-9][\w.]*"
    r'|"[^\r\n]*'
    r"|[^ \t\r\n\f])"
)
TOKENS: Final = re.compile(rf"{_TRIVIA}(?:{_TOKEN}|\Z)")
"""An empty token stands for what is behind the last one."""
TILES: Final = re.compile(_TOKEN + "(" + _TRIVIA + ")")
TOUCHING: Final = re.compile(rf"[0-9.](?=[ADMOSTXadmostx]){_GOING_ON}")
"""A number and the word behind it, if that is what they are; the letters make it quick."""
HEADER: Final = re.compile(r"\s*%%%(?:.*?)%%%[^\r\n]*", re.DOTALL)
LEAD: Final = re.compile(_TRIVIA)
