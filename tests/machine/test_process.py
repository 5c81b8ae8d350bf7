"""One or two processes: waits, wake-ups, turns; paused, closed clocks."""

import threading

import pytest

from rapidgen.machine.process import Process
from rapidgen.machine.scheduler import CLOSED, MS, Scheduler


class Attending(Process):
    """Notes when it attends."""

    def __init__(self, scheduler, name="p"):
        super().__init__(scheduler, name)
        self.attended = []

    def process_pending(self):
        self.attended.append(self.scheduler.now)


def test_woken_process_handles_pending_first():
    scheduler, seen = Scheduler(), []
    process = Attending(scheduler)
    assert not process.alive
    assert process.frame is None

    def body():
        process.charge(MS)
        process.block()
        seen.append((scheduler.now, list(process.attended)))

    process.launch(body)
    process.wake()  # it does not wait for anything
    assert scheduler.advance() == "idle"
    assert process.alive
    assert process.frame is not None
    scheduler.after(MS, process.wake)
    scheduler.advance()
    assert seen == [(2 * MS, [2 * MS])]
    assert not process.alive


def test_abandoned_process_can_be_launched_again():
    scheduler, seen = Scheduler(), []
    process = Process(scheduler, "p")
    process.launch(process.block)
    scheduler.advance()
    process.abandon()
    assert not process.alive
    process.wake()
    assert not scheduler.ready
    process.launch(lambda: seen.append("again"))
    scheduler.advance()
    assert seen == ["again"]


def test_a_kick_is_attended_before_the_next_statement():
    scheduler = Scheduler()
    process = Attending(scheduler)
    left = []

    def body():
        process.wake_at_next_statement()
        left.append(process.b)
        process.process_pending_if_woken()
        left.append(list(process.attended))
        process.process_pending_if_woken()
        process.charge(MS)
        left.append(scheduler.now)

    process.launch(body)
    scheduler.advance()
    assert left == [-1, [0], MS]
    assert process.attended == [0]


def test_a_kick_from_outside_ends_a_wait():
    scheduler = Scheduler()
    process = Attending(scheduler)
    process.launch(process.block)
    scheduler.after(3 * MS, process.wake_at_next_statement)
    scheduler.advance()
    assert process.attended == [3 * MS]


def turns(way, attends):
    """Two processes that give way after each of three statements."""
    scheduler, seen = Scheduler(), []
    processes = [Attending(scheduler, name) for name in "ab"]

    def body(process):
        for _ in range(3):
            seen.append(process.name)
            process.charge(MS // 10)
            way(process)

    for process in processes:
        process.launch(lambda process=process: body(process))
    scheduler.advance()
    assert [len(process.attended) for process in processes] == [attends, attends]
    assert scheduler.now == 6 * (MS // 10)
    return "".join(seen)


def test_yielding_process_runs_after_ready_ones():
    assert turns(Process.yield_cpu, attends=3) == "ababab"
    assert turns(Process.switch, attends=0) == "ababab"


def test_wake_during_switch_is_handled_before_statement():
    scheduler = Scheduler()
    process, other = Attending(scheduler), Process(scheduler, "q")
    before = []

    def body():
        process.switch()
        before.append((process.b, list(process.attended)))
        process.charge(1)

    process.launch(body)
    other.launch(process.wake_at_next_statement)
    scheduler.advance()
    assert before == [(-1, [])]
    assert process.attended == [1]


# -- clocks --------------------------------------------------------------------------------------


def test_pause_stops_time_and_runs_posts():
    scheduler, seen = Scheduler(), []
    process = Process(scheduler, "p")

    def body():
        process.charge(MS)
        seen.append("before")
        scheduler.pause(process)
        seen.append("after")
        process.charge(MS)

    process.launch(body)
    scheduler.after(10 * MS, lambda: seen.append("event"))
    assert scheduler.advance(20 * MS) == "paused"
    assert (seen, scheduler.now, scheduler.paused) == (["before"], MS, True)
    assert scheduler.preempted is process
    scheduler.post(lambda: seen.append("posted"))
    assert scheduler.advance(20 * MS) == "paused"
    assert scheduler.now == MS
    scheduler.resume()
    scheduler.resume()
    assert scheduler.advance(20 * MS) == "time"
    assert (seen, scheduler.now) == (["before", "posted", "after", "event"], 20 * MS)
    assert not scheduler.paused


def test_paused_real_clock_waits_for_posts():
    scheduler, seen = Scheduler(clock="real", speed=1000.0), []
    scheduler.pause()
    scheduler.after(1, lambda: seen.append("event"))

    def posted():
        seen.append((list(seen), scheduler.now))
        scheduler.resume()

    thread = threading.Thread(target=lambda: scheduler.post(posted))
    scheduler.post(thread.start)
    assert scheduler.advance(stop=lambda: "event" in seen) == "stop"
    thread.join()
    assert seen == [([], 0), "event"]
    scheduler.close()


def test_nothing_of_a_closed_clock_goes_on():
    scheduler, seen = Scheduler(clock="real"), []
    process = Process(scheduler, "p")
    process.launch(process.block)
    scheduler.after(MS, lambda: seen.append("event"))
    scheduler.call_later_readonly(MS, lambda: seen.append("look"))
    scheduler.advance(stop=lambda: process.frame is not None)
    scheduler.close_processes([process])
    assert not process.alive
    assert scheduler.next_event() is None
    assert scheduler.preempted is None
    assert not scheduler.ready
    for _ in range(2):
        scheduler.close()
    with pytest.raises(RuntimeError, match=CLOSED):
        scheduler.advance()
    assert seen == []


def test_advance_within_advance_raises():
    scheduler, refused = Scheduler(), []

    def again():
        with pytest.raises(RuntimeError, match="time passes already") as error:
            scheduler.advance()
        refused.append(error)

    scheduler.after(MS, again)
    assert scheduler.advance() == "idle"
    assert refused
    assert scheduler.advance(2 * MS) == "time"


def test_another_thread_does_not_let_time_pass():
    scheduler, message = Scheduler(), []
    process = Process(scheduler, "p")

    def body():
        for _ in range(3):
            process.charge(30 * MS)

    def step():
        try:
            scheduler.advance()
        except RuntimeError as error:
            message.append(str(error))

    process.launch(body)
    assert scheduler.advance(MS) == "time"
    thread = threading.Thread(target=step)
    thread.start()
    thread.join()
    assert len(message) == 1
    assert "one thread steps a controller" in message[0]
    # Its own goes on from there.
    assert (scheduler.running, scheduler.preempted) == (None, process)
    assert scheduler.advance() == "idle"
    assert not process.alive


@pytest.mark.parametrize("options", [{"clock": "wall"}, {"schedule": "by lot"}])
def test_unknown_option_is_rejected(options):
    (name,) = options
    with pytest.raises(ValueError, match=f"{name}='{options[name]}' is none of"):
        Scheduler(**options)


def test_single_process_runs_for_50_ms():
    scheduler = Scheduler()
    process = Attending(scheduler)

    def body():
        for _ in range(120):
            process.charge(MS)

    process.launch(body)
    scheduler.advance()
    assert process.attended == [51 * MS, 102 * MS]


def test_post_runs_at_next_poll_of_process():
    scheduler, seen = Scheduler(), []
    process = Process(scheduler, "p")

    def body():
        scheduler.post(lambda: seen.append("posted"))
        process.charge(MS)
        seen.append("not yet")
        process.charge(50 * MS)
        seen.append("polled")

    process.launch(body)
    scheduler.advance()
    assert seen == ["not yet", "posted", "polled"]


def test_lost_priority_orders_by_number_of_losses():
    scheduler, seen = Scheduler(schedule="priorities", seed=3), []
    first, second = Process(scheduler, "a"), Process(scheduler, "b")

    def accesses(process, count):
        for _ in range(count):
            seen.append(process.name)
            process.charge(1)
            if scheduler.switches_here():
                process.switch()

    def alone():
        accesses(first, 3)
        second.launch(lambda: accesses(second, 3))
        first.switch()
        accesses(first, 3)

    first.launch(alone)
    scheduler.preempt([1, 2, 3, 4])
    scheduler.advance()
    assert "".join(seen) == "aaa" + "b" + "aaa" + "bb"
