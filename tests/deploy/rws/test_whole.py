"""From an empty controller to a serving driver and back, over web services of each generation."""


def test_deployed_restarted_and_taken_off_again(rws, generation, tmp_path):
    wanted = rws.build(generation)
    with rws.empty_cabinet(tmp_path, generation) as cabinet:
        home, cfg = rws.home_of(cabinet), rws.cfg_of(cabinet)
        transport = rws.connect(rws.Line(cabinet, generation))
        said = []
        rws.run(transport, wanted, said=said)
        print("\n".join(said))
        assert rws.run(transport, wanted).is_empty
        assert rws.run(transport, None, "uninstall")
        assert rws.home_of(cabinet) == home
        assert rws.cfg_of(cabinet) == cfg
        modules = cabinet.programs.modules(cabinet.controller.rapid_tasks["T_ROB1"])
        assert [m.name for m in modules] == ["MainModule"]
