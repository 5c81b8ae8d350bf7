"""Random modules from a seed: every construct, with all kinds of gaps."""

import random

NAMES = ("a", "b2", "größe", "p_10", "Stop", "reg1")
LITERALS = ("0", "1", "38.", ".27", "2.5E-3", "0x1F", "9E9", "TRUE", "false")
STRINGS = ('""', '"a b"', '"q""q"', '"\\\\"', '"\\0A!"')
GAPS = (" ", " ", " ", " ", "\n", "\r\n", "\t", " ! note ; IF\n", "\n\n\n! x\n")
OPTIONAL = (
    "\\", "s", ",", "*", ",", "\\", "p", "?", "q", "\\", "r", ",", "v", ":=", "1", ";",
)  # fmt: skip


class Writer:
    """Writes one module as tokens."""

    def __init__(self, seed):
        self.chance = random.Random(seed)

    def pick(self, *choices):
        return self.chance.choice(choices)

    def value(self, depth=0):
        """Tokens of an expression."""
        c = self.chance
        if depth > 3 or c.random() < 0.4:
            return [c.choice(c.choice((NAMES, LITERALS, STRINGS)))]
        inner = self.value(depth + 1)
        name = c.choice(NAMES)
        return self.pick(
            ["(", *inner, ")"],
            ["(", *inner, self.pick("*", "/", "DIV", "mod", "+", "-"), *self.value(depth + 1), ")"],
            ["(", "NOT", *inner, self.pick("OR", "AND", "xor"), "TRUE", ")"],
            ["(", "-", *inner, ")"],
            ["(", *inner, self.pick("<", "<=", ">", ">=", "=", "<>"), *self.value(depth + 1), ")"],
            ["[", *inner, ",", *self.value(depth + 1), "]"],
            [name, "(", *inner, "\\", "o", ":=", "1", "\\", "s", "\\", "q", "?", "b2", ")"],
            [name, "{", *inner, "}", ".", "x", ".", "y"],
            [name, "(", ")"],
        )

    def simple(self):
        """Tokens of a simple statement."""
        name, value = self.chance.choice(NAMES), self.value()
        return self.pick(
            [name, ":=", *value, ";"],
            [name, "{", *value, "}", ".", "x", ":=", *self.value(), ";"],
            [name, ";"],
            [name, *value, ",", *self.value(), "\\", "o", ":=", *self.value(), ";"],
            [name, *OPTIONAL],
            ["%", '"p"', "+", name, "%", *value, ";"],
            ["RETURN", *value, ";"],
            self.pick(["RETURN", ";"], ["EXIT", ";"], ["GOTO", "l", ";"], ["RAISE", "5", ";"]),
            ["CONNECT", "i", "WITH", "t", ";"],
        )

    def statements(self, depth=0):
        """Tokens of a list of statements."""
        result = []
        for _ in range(self.chance.randrange(4)):
            result += self.statement(depth)
        return result

    def statement(self, depth):
        """Tokens of one statement."""
        if depth > 2 or self.chance.random() < 0.5:
            return self.simple()
        inner, value = self.statements(depth + 1), self.value()
        return self.pick(
            ["IF", *value, "THEN", *inner, "ENDIF"],
            ["IF", "a", "THEN", *inner, "ELSEIF", *value, "THEN", "else", *inner, "EndIf"],
            ["IF", *value, *self.simple()],
            ["FOR", "i", "FROM", "1", "TO", *value, "DO", *inner, "ENDFOR"],
            ["FOR", "i", "FROM", "1", "TO", "9", "STEP", *value, "DO", *inner, "ENDFOR"],
            ["while", *value, "DO", *inner, "ENDWHILE"],
            ["TEST", *value, "CASE", "1", ",", "2", ":", *inner, "DEFAULT", ":", "ENDTEST"],
            ["l", ":"],
            ["<SMT>"],
        )

    def datum(self):
        """Tokens of a data declaration."""
        scope, kind = self.pick("", "LOCAL", "TASK"), self.pick("VAR", "PERS", "const")
        head = [scope] if scope and not (kind == "const" and scope == "TASK") else []
        size = self.pick([], ["{", "2", "}"], ["{", "2", ",", "n", "}"])
        name = self.chance.choice(NAMES)
        return [*head, kind, "num", name, *size, ":=", *self.value(), ";"]

    def routine(self):
        """Tokens of a routine."""
        formal = ["VAR", "num", "x", ",", "\\", "switch", "s", "|", "PERS", "n", "y", "{", "*", "}"]
        head, end = self.pick(
            (["PROC", "p", "(", ")"], "ENDPROC"),
            (["LOCAL", "FUNC", "num", "f", "(", *formal, ")"], "ENDFUNC"),
            (["TRAP", "t"], "ENDTRAP"),
        )
        handlers = self.pick(
            [],
            ["ERROR", "(", "1", ",", "e", ")", "RETRY", ";"],
            ["ERROR", "RAISE", ";", "UNDO", "a", ";"],
        )
        return [*head, "VAR", "num", "d", ";", *self.statements(), *handlers, end]

    def module(self):
        """Tokens of a module."""
        result = ["MODULE", "m", "(", "SYSMODULE", ",", "READONLY", ")"]
        if self.chance.random() < 0.5:
            result += ["LOCAL", "RECORD", "r", "num", "x", ";", "r2", "y", ";", "ENDRECORD"]
            result += ["ALIAS", "num", "n", ";"]
        for _ in range(self.chance.randrange(4)):
            result += self.datum()
        for _ in range(self.chance.randrange(4)):
            result += self.routine()
        return [*result, "ENDMODULE"]

    def text(self):
        """The module with gaps between its tokens."""
        return "".join(token + self.chance.choice(GAPS) for token in self.module())


def program(seed):
    """Text of the module that belongs to a seed."""
    return Writer(seed).text()
