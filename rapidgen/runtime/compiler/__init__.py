"""Compiler from RAPID routines to Python functions.

Stages: `link` makes types, data and routines of the names of a task. `emit` writes a routine as
Python source. `program` compiles routines on their first call and owns the namespace. `emitted`
keeps their code for other controllers of the process with the same modules. `resume` compiles the
rest of a routine for a place inside it, for resumption and for watched expressions. `support`
contains the functions that compiled code calls, `symbols` what all stages know about data and code.

Rules of the generated code:

1. A RAPID routine is one Python function with the routine's variables as Python locals. Arguments
   passed by reference are boxes (`values.Ref`), persistents are cells (`values.PersistentCell`).
2. A statement that fails for a reason known at compile time compiles to a call that raises the
   error when execution reaches it. Loading a module never fails for the content of a routine [K
   §4.5].
3. Time is a budget in nanoseconds, the Python local `b`. A block of statements pays its costs
   before it runs, `R.poll` gives control to the scheduler when the budget is negative. Before a
   call that may wait, `R.b = b` publishes the budget; afterwards `b = R.b` reads it back.
4. A num is rounded to IEEE single when it is stored, passed or returned [K §2.13]. Whole numbers
   are Python ints. The emitter proves from value ranges that most roundings are unnecessary.
5. Within a routine with ERROR, each statement that can fail is a `try`. Its handler is a nested
   function, whose result says how execution continues: 0 RETRY, 1 TRYNEXT, 2 RETURN, 3 RAISE, 4 end
   of the handler.
6. GOTO needs a state machine: a list with a label that a GOTO names becomes a `while True` with one
   `if` per section. A GOTO out of Python loops sets `_j` and breaks out loop by loop.
7. Blocks nested beyond CPython's limit become nested functions of the same kind as handlers.

Names in generated code: `R` is the task (`task.Task`), `v_name` a parameter, `m3_name` an object of
the third module, `p_name` a predefined datum, `B_name` a built-in, `k7` or `k1_m3_name` any other
object.
"""
