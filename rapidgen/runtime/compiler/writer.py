"""Python text under construction: lines, the RAPID they come from, and what they are charged.

Costs are paid before the statements of a block run. A block is a run of statements that touch
only the routine's own data, with at most one other statement as its last. When the budget does
not last for the block, `polls` charges it statement by statement, so that block and statement
accounting tell exactly the same times.
"""

from dataclasses import dataclass, field

INDENT = " "
_BUDGET_LINES = frozenset({"b = R.b", "R.b = b", "else: b = R.b", "b += @REFUND@"})
"""What nobody needs without accounting."""
_FILLED = frozenset({"b += @REFUND@", "b -= @OWN@", "b = R.charge_again(b, @REST@)"})
"""Lines with a cost that is known when the block is."""


@dataclass(slots=True, eq=False)
class Block:
    """Costs of the statements that are paid together."""

    costs: list[int] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class CodeLine:
    """One line of Python."""

    depth: int
    text: str
    token: int
    """First token of the RAPID statement."""
    block: Block | None = None
    paid: int = 0
    """Costs of the block up to and with this statement's."""
    charge: bool = False
    """This is where the block is paid."""
    synced: bool = False
    """The budget was written back before; whoever raised knows better what is left."""
    leave: str = ""
    """Of a charge: how RETURN of an ERROR (list) leaves, where a long jump may end here."""


@dataclass(frozen=True, slots=True)
class Mark:
    """How far a writer is."""

    lines: int
    depth: int
    leave: str
    block: Block | None
    costs: int


class Writer:
    """Collects lines."""

    def __init__(self, accounting: str) -> None:
        self.lines: list[CodeLine] = []
        self.depth = 0
        self.token = 0
        self.synced = False
        self.leave = ""
        """RETURN of the routine's ERROR (list); empty: it has none, or this is a handler."""
        self._accounting = accounting
        self._block: Block | None = None

    def emit(self, text: str) -> None:
        """Add one line at the current depth."""
        if self._accounting == "none" and text in _BUDGET_LINES:
            return
        block = self._block
        paid = len(block.costs) if block is not None else 0
        self.lines.append(CodeLine(self.depth, text, self.token, block, paid, False, self.synced))

    def mark(self) -> "Mark":
        """What is written so far, for `back_to`."""
        costs = len(self._block.costs) if self._block is not None else 0
        return Mark(len(self.lines), self.depth, self.leave, self._block, costs)

    def back_to(self, marker: "Mark") -> None:
        """Forget what was written since."""
        del self.lines[marker.lines :]
        self.depth, self.leave, self.synced, self._block = (
            marker.depth,
            marker.leave,
            False,
            marker.block,
        )
        if marker.block is not None:
            del marker.block.costs[marker.costs :]

    def cut(self, marker: int) -> list[CodeLine]:
        """Take off the lines from a place on."""
        lines = self.lines[marker:]
        del self.lines[marker:]
        return lines

    def cost(self, amount: int) -> None:
        """The next lines belong to a statement of this cost."""
        if self._accounting == "none":
            return
        if self._block is None or self._accounting == "statement":
            self._block = Block()
            line = CodeLine(self.depth, "", self.token, self._block, charge=True, leave=self.leave)
            self.lines.append(line)
        self._block.costs.append(amount)

    def close(self) -> None:
        """End the block: what follows is paid on its own."""
        self._block = None

    def render(self) -> tuple[str, list[int], dict[int, int], set[int]]:
        """Python text; tokens by line (from 1); refunds by line; lines that are synced."""
        text: list[str] = []
        tokens = [0]
        refunds: dict[int, int] = {}
        synced: set[int] = set()

        def add(depth: int, code: str, token: int) -> None:
            text.append(INDENT * depth + code)
            tokens.append(token)

        for line in self.lines:
            block = line.block
            if line.charge and block is not None:
                costs = block.costs
                total = sum(costs)
                poll = f"R.polls(b, {tuple(costs)})" if len(costs) > 1 else "R.poll(b)"
                add(line.depth, f"b -= {total}", line.token)
                if not line.leave:
                    add(line.depth, f"if b < 0: b = {poll}", line.token)
                    continue
                # A trap is served here: its long jump may end in this routine [K §7.2].
                add(line.depth, "if b < 0:", line.token)
                add(line.depth + 1, f"try: b = {poll}", line.token)
                add(line.depth + 1, "except ERRS as _e:", line.token)
                add(line.depth + 2, "_k = R.handle(_h, _e, None, 0, _l)", line.token)
                add(line.depth + 2, "b = R.b", line.token)
                add(line.depth + 2, f"if _k == 2: {line.leave}", line.token)
                continue
            code = line.text
            remaining = tuple(block.costs[line.paid :]) if block is not None else ()
            refund = sum(remaining)
            if code in _FILLED:
                code = code.replace("@REFUND@", str(refund))
                code = code.replace("@REST@", repr(remaining) if remaining else "()")
                own = block.costs[line.paid - 1] if block is not None and line.paid else 0
                code = code.replace("@OWN@", str(own))
            if code in ("", "b += 0", "b = R.charge_again(b, ())"):
                continue
            add(line.depth, code, line.token)
            if refund:
                refunds[len(tokens) - 1] = refund
            if line.synced:
                synced.add(len(tokens) - 1)
        return "\n".join(text) + "\n", tokens, refunds, synced
