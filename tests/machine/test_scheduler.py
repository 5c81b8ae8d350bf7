"""Clock, events, processes."""

import subprocess
import sys
import threading
import time
from functools import partial

import pytest

from rapidgen.machine.process import Process
from rapidgen.machine.scheduler import MS, S, Scheduler, WaitSet


def test_events_come_in_order_of_time_then_of_making() -> None:
    scheduler, seen = Scheduler(), []
    scheduler.at(20, lambda: seen.append("c"))
    scheduler.at(10, lambda: seen.append("a"))
    scheduler.at(10, lambda: seen.append("b"))
    gone = scheduler.at(15, lambda: seen.append("never"))
    gone.cancel()
    assert not gone.active
    assert scheduler.advance() == "idle"
    assert (seen, scheduler.now) == (["a", "b", "c"], 20)


def test_event_time_is_exact_during_process() -> None:
    scheduler, seen = Scheduler(), []
    process = Process(scheduler, "p")
    process.launch(lambda: [process.charge(3 * MS) for _ in range(5)])
    scheduler.at(4 * MS, lambda: seen.append(scheduler.now))
    scheduler.advance()
    assert seen == [4 * MS]
    assert scheduler.now == 15 * MS


def test_an_event_made_by_a_running_process_shortens_its_budget() -> None:
    scheduler, seen = Scheduler(), []
    process = Process(scheduler, "p")

    def body() -> None:
        scheduler.after(MS, lambda: seen.append(scheduler.now))
        process.charge(MS // 2)
        assert not seen
        process.charge(MS)
        assert seen == [MS]

    process.launch(body)
    scheduler.advance()
    assert scheduler.now == 3 * MS // 2


def test_until_and_stop() -> None:
    scheduler = Scheduler()
    ticks: list[int] = []

    def tick() -> None:
        ticks.append(scheduler.now)
        scheduler.after(10, tick)

    scheduler.after(10, tick)
    assert scheduler.advance(until=35) == "time"
    assert (ticks, scheduler.now) == ([10, 20, 30], 35)
    assert scheduler.advance(until=1000, stop=lambda: len(ticks) == 5) == "stop"
    assert scheduler.now == 50


def test_running_in_pieces_changes_nothing() -> None:
    def order(pieces: int) -> list[str]:
        scheduler, seen = Scheduler(), []
        for name in "abc":
            process = Process(scheduler, name)

            def body(process: Process = process) -> None:
                for _ in range(7):
                    process.charge(MS)
                    seen.append(f"{process.name}{scheduler.now}")

            process.launch(body)
        for i in range(1, pieces + 1):
            scheduler.advance(until=21 * MS * i // pieces)
        scheduler.advance()
        return seen

    assert order(1) == order(13) == order(100)


def test_readonly_call_changes_nothing() -> None:
    def run(looks: bool) -> tuple[list[tuple[str, int]], list[int], list[int]]:
        scheduler = Scheduler(seed=3, schedule="random", quantum=2 * MS)
        turns, seen, requested = [], [], []

        def look() -> None:
            seen.append(scheduler.now)
            scheduler.call_later_readonly(MS // 3, look)

        def body(name: str) -> None:
            for _ in range(20):
                process = processes[name]
                process.charge(MS)
                turns.append((name, scheduler.now))

        def stop() -> bool:
            requested.append(scheduler.now)
            return False

        processes = {name: Process(scheduler, name) for name in "ab"}
        for name, process in processes.items():
            process.launch(partial(body, name))
        if looks:
            look()
        scheduler.after(5 * MS, lambda: None)
        assert scheduler.advance(stop=stop) == "idle"
        assert scheduler.advance(until=scheduler.now + MS) == "time"
        return turns, requested, seen

    turns, requested, seen = run(looks=True)
    assert (turns, requested, []) == run(looks=False)
    assert seen == sorted(seen)
    assert len(seen) > 100


def test_a_wait_set_wakes_in_order() -> None:
    scheduler, seen, done = Scheduler(), [], WaitSet()
    for name in "ab":
        process = Process(scheduler, name)

        def body(process: Process = process) -> None:
            done.add(process.wake)
            process.block()
            done.remove(process.wake)
            seen.append(process.name)

        process.launch(body)
    scheduler.after(5, done.notify)
    scheduler.advance()
    assert seen == ["a", "b"]
    assert not done


def test_an_exception_of_a_process_is_not_swallowed() -> None:
    scheduler = Scheduler()
    process = Process(scheduler, "p")
    process.launch(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        scheduler.advance()


def test_real_clock_follows_wall_and_runs_posts() -> None:
    scheduler, seen = Scheduler(clock="real"), []
    scheduler.after(50 * MS, lambda: seen.append("timer"))
    thread = threading.Thread(target=lambda: scheduler.post(lambda: seen.append("posted")))
    started = time.monotonic()
    thread.start()
    assert scheduler.advance(until=100 * MS) == "time"
    thread.join()
    assert time.monotonic() - started > 0.09
    assert sorted(seen) == ["posted", "timer"]
    scheduler.close()


def test_lagging_machine_does_not_catch_up_in_burst() -> None:
    scheduler = Scheduler(clock="real")

    def stall() -> None:
        start, wall = scheduler._origin
        scheduler._origin = (start, wall - 10_000 * MS)

    scheduler.after(1 * MS, stall)
    scheduler.after(2 * MS, lambda: None)
    started = time.monotonic()
    scheduler.advance(until=500 * MS)
    assert time.monotonic() - started > 0.2
    scheduler.close()


def test_speed() -> None:
    scheduler = Scheduler(clock="real", speed=100)
    started = time.monotonic()
    scheduler.advance(until=60_000 * MS)
    assert 0.5 < time.monotonic() - started < 50
    scheduler.close()


def _who_runs(accesses: list[int]) -> str:
    """Three processes that look at something shared, under priorities."""
    scheduler, seen = Scheduler(schedule="priorities", seed=3), []

    def works(process: Process) -> None:
        for _ in range(4):
            seen.append(process.name)
            process.charge(1000)
            if scheduler.switches_here():
                process.switch()

    processes = [Process(scheduler, name) for name in "abc"]
    for process in processes:
        process.launch(lambda process=process: works(process))
    scheduler.preempt(accesses)
    scheduler.advance()
    return "".join(seen)


def test_highest_priority_runs_until_lost() -> None:
    undisturbed = _who_runs([])
    assert len({undisturbed[n : n + 4] for n in (0, 4, 8)}) == 3
    first, second, third = undisturbed[0], undisturbed[4], undisturbed[8]
    # At the second access the running process becomes the last of all.
    assert _who_runs([2]) == first * 2 + second * 4 + third * 4 + first * 2
    assert _who_runs([2, 3]) == first * 2 + second + third * 4 + first * 2 + second * 3


def test_long_wait_precedes_priority() -> None:
    scheduler, seen = Scheduler(schedule="priorities", seed=3), []

    def works(process: Process) -> None:
        for _ in range(40):
            seen.append(process.name)
            process.charge(MS)

    for name in "ab":
        process = Process(scheduler, name)
        process.launch(lambda process=process: works(process))
    scheduler.advance()
    other = next(name for name in "ab" if name != seen[0])
    assert 20 <= seen.index(other) <= 25


def test_pace_0_stops_time_until_next_pace() -> None:
    scheduler, seen = Scheduler(clock="real"), []
    scheduler.after(3600 * S, lambda: seen.append(scheduler.now))
    scheduler.pace(0.0)
    stood = []
    for _ in range(2):
        scheduler.post(lambda: stood.append(scheduler.now))
        scheduler.advance(stop=lambda: bool(stood))
        time.sleep(0.01)
    assert stood[0] == stood[-1] == scheduler.now
    scheduler.pace(1e6)
    scheduler.advance(stop=lambda: bool(seen))
    assert seen == [3600 * S]
    scheduler.close()


def test_a_thread_may_end_while_its_scheduler_is_collected() -> None:
    """greenlet 3.5.6 freed the thread's own greenlet, and crashed."""
    program = """if True:
        import gc, threading
        from rapidgen.machine.process import Process
        from rapidgen.machine.scheduler import Scheduler

        class Garbage:
            def __init__(self, scheduler):
                self.scheduler, self.circle = scheduler, self
                self.ran, self.end = threading.Event(), threading.Event()
                self.thread = threading.Thread(target=run, args=([scheduler], self.ran, self.end))
                self.thread.start()
                self.ran.wait()

            def __del__(self):
                self.end.set()
                self.thread.join()
                [None for _ in range(100)]  # Python sees to what the thread has left

        def run(scheduler, ran, end):
            scheduler.pop().advance()
            ran.set()
            end.wait()

        scheduler = Scheduler()
        Process(scheduler, "p").launch(lambda: None)
        scheduler.circle = Garbage(scheduler)
        del scheduler
        print(gc.collect() > 0)
    """
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (0, "True\n"), done.stderr


def test_stopped_time_limits_computing_to_1_ms() -> None:
    class Standing(Scheduler):
        def _serve(self, timeout: float | None) -> None:
            over.append(timeout)

    over: list[float | None] = []
    # A slice ends with every charge.
    scheduler = Standing(clock="real", quantum=MS - 1)
    scheduler.pace(0.0)
    began = scheduler._now = scheduler._wall()
    process, seen = Process(scheduler, "p"), []

    def body() -> None:
        for _ in range(5):
            process.charge(MS)
            seen.append(scheduler.now - began)

    process.launch(body)
    assert scheduler.advance(stop=lambda: bool(over)) == "stop"
    # It goes on at exactly that, and is over it with what it then does.
    assert (seen, scheduler.now - began, over) == ([MS], 2 * MS, [None])
    scheduler.close()
