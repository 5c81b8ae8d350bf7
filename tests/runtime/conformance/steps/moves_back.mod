MODULE moves_back
    ! source: [S4 2-SearchL-6] backward a move carries out the movement: only one that was stepped, from where it ended
    ! robot: irb120
    ! signal: lamp DO
    ! case:
    ! do: start, run 4.5, stop, run 2
    ! at: main WaitTime 9;
    ! do: service look, run 0.5
    ! expect: [314.354,0,544]
    ! do: step back
    ! at: main WaitTime 9;
    ! log: 40700 MoveJ: where it began is not known, or the robot does not stand at its end
    ! do: service look, run 0.5
    ! expect: [314.354,0,544]
    ! case:
    ! do: step, step, jog 0.01
    ! do: service look, run 0.5
    ! expect: [366.038,104.654,585.889]
    ! do: step back
    ! at: main MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
    ! log: 40700 MoveLDO: where it began is not known, or the robot does not stand at its end
    ! do: service look, run 0.5
    ! expect: [366.038,104.654,585.889]
    ! case: moves_back=false
    ! do: step, step, service look, run 0.5
    ! expect: [364.354,100,594]
    ! do: step back
    ! at: main MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
    ! log: 40700 MoveLDO is not executed backward
    ! do: service look, run 0.5
    ! expect: [364.354,100,594]
    ! case:
    ! [S4 2-TriggL] "no trigger activities at all are carried out"
    ! do: step, step
    ! value: lamp = 1
    ! do: signal lamp 0, step back
    ! at: main MoveLDO Offs(a, 0, 100, 0), v500, z20, tool0, lamp, 1;
    ! value: lamp = 0
    CONST robtarget a := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveAbsJ home, v1000, z50, tool0;
        MoveLDO Offs(a, 0, 100, 0), v500, z20, tool0, lamp, 1;
        MoveC Offs(a, 50, 150, 0), Offs(a, 0, 200, 0), v500, z20, tool0;
        MoveJ Offs(a, -50, 0, -50), v1000, z50, tool0;
        WaitTime 9;
    ENDPROC
    PROC look()
        VAR pos here;
        here := CPos(\Tool:=tool0);
        here := [Round(here.x \Dec:=3),Round(here.y \Dec:=3),Round(here.z \Dec:=3)];
        TPWrite ValToStr(here);
    ENDPROC
ENDMODULE
