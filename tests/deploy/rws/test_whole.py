"""From an empty controller to a serving driver and back, over web services of each generation."""

from rapidgen.wire.rws.bodies import Generation


def test_deployed_restarted_and_taken_off_again(rws, generation, tmp_path):
    wanted = rws.build(generation)
    with rws.empty_runner(tmp_path, generation) as controller_runner:
        home, cfg = rws.home_of(controller_runner), rws.cfg_of(controller_runner)
        line = rws.Line(controller_runner, generation)
        transport = rws.connect(line)
        rws.run(transport, wanted)
        assert len(line.app.sessions) == 1  # the restart has dropped every session
        if generation is Generation.EIGHT:
            changes = [target for method, target in line.log if method != "GET"]
            first = next(n for n, t in enumerate(changes) if t.startswith("/fileservice/HOME"))
            assert changes[first - 1].endswith("/writeaccess/request")
        assert rws.run(transport, wanted).is_empty
        assert rws.run(transport, None, "uninstall")
        assert rws.home_of(controller_runner) == home
        assert rws.cfg_of(controller_runner) == cfg
        modules = controller_runner.programs.modules(
            controller_runner.controller.rapid_tasks["T_ROB1"]
        )
        assert [m.name for m in modules] == ["MainModule"]
