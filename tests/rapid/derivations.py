"""Random texts of the second grammar: every rule, to a bounded depth."""

from collections import defaultdict

from lark.grammar import NonTerminal

SAMPLES = {
    "NAME": ("a", "b2", "größe", "p_10", "Stop", "x" * 32),
    "NUMBER": ("0", "1", "38.", ".27", "2.5E-3", "0x1F", "9E9"),
    "STRING": ('""', '"a b"', '"q""q"', '"\\\\"', '"\\0A!"'),
}
_DEEP = 24


class Derivations:
    """Derives texts of a grammar; the deeper, the shorter what is chosen."""

    def __init__(self, lark):
        self.rules = defaultdict(list)
        for rule in lark.rules:
            self.rules[rule.origin.name].append(rule.expansion)
        self.words = {t.name: self._words(t) for t in lark.terminals}
        self.least = self._least()

    @staticmethod
    def _words(terminal):
        if terminal.name in SAMPLES:
            return SAMPLES[terminal.name]
        text = terminal.pattern.value
        word = text.removesuffix("\\b") if terminal.pattern.type == "re" else text
        return (word, word.lower(), word.capitalize()) if word.isalpha() else (word,)

    def _least(self):
        """Depth of the shallowest derivation of each rule."""
        least = dict.fromkeys(self.rules, 10_000)
        changed = True
        while changed:
            changed = False
            for name, expansions in self.rules.items():
                depth = min(self._depth(e, least) for e in expansions)
                if depth < least[name]:
                    least[name], changed = depth, True
        return least

    @staticmethod
    def _depth(expansion, least):
        return 1 + max((least[s.name] for s in expansion if isinstance(s, NonTerminal)), default=0)

    def tokens(self, chance, name="start", depth=0):
        """Tokens of one derivation of the rule `name`."""
        choices = self.rules[name]
        if depth > _DEEP * chance.random():
            least = min(self._depth(e, self.least) for e in choices)
            choices = [e for e in choices if self._depth(e, self.least) == least]
        result = []
        for symbol in chance.choice(choices):
            if isinstance(symbol, NonTerminal):
                result += self.tokens(chance, symbol.name, depth + 1)
            else:
                result.append(chance.choice(self.words[symbol.name]))
        return result
