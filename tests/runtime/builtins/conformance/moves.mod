MODULE moves
    ! source: [manual] S4 MoveL to MoveC, CRobT, CPos, CJointT, CalcJointT, CalcRobT, PDispSet, PDispOn, WaitRob, CirPathMode
    ! robot: irb120
    ! expect: [364.354,0,594] [0.5,0,0.866025,0]
    ! expect: 30 9E+09
    ! expect: [374.354,40,624]
    ! expect: [364.354,0,594]
    ! expect: tool [350.956,-50,544]
    ! expect: [350.956,-70,544]
    ! expect: [364.354,-20,594]
    ! expect: [364.354,0,594] [0.5,0,0.866025,0]
    ! expect: 30
    ! expect: outside reach
    ! expect: its number
    ! In the displaced frame.
    ! expect: [364.354,0,594]
    ! expect: 50
    ! expect: [364.354,0,594]
    ! An active displacement is added to.
    ! expect: [364.354,30,614]
    ! expect: [364.354,50,594]
    ! expect: [364.354,50,594] [0.5,0,0.866025,0]
    ! expect: own
    ! expect: free
    ! Axes 4, 5, 6 = 30, 30, 0 or -150, -30, 180: one pose, two configurations.
    ! expect: -150
    ! expect: -150
    ! expect: 30
    CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget turned := [[0,0,0,30,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p := [[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PERS tooldata t := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS wobjdata w := [FALSE,TRUE,"",[[100,0,0],[1,0,0,0]],[[0,50,0],[1,0,0,0]]];
    VAR robtarget q;
    VAR jointtarget j;
    VAR errnum n;
    PROC main()
        MoveAbsJ home, v1000, fine, tool0;
        q := CRobT();
        TPWrite place(q.trans) + " " + turn(q.rot);
        j := CJointT();
        TPWrite ValToStr(Round(j.robax.rax_5 \Dec:=3)) + " " + ValToStr(j.extax.eax_a);
        MoveL Offs(p, 10, 20, 30), v200, z10, tool0;
        MoveC Offs(p, 10, 30, 40), Offs(p, 10, 40, 30), v200, fine, tool0;
        TPWrite place(CPos());
        MoveJ p, v200, fine, tool0;
        TPWrite place(CPos());
        MoveAbsJ home, v1000, fine, tool0;
        q := CRobT(\Tool:=t \WObj:=w);
        TPWrite "tool " + place(q.trans);
        MoveL Offs(q, 0, -20, 0), v200, fine, t \WObj:=w;
        TPWrite place(CPos());
        TPWrite place(CPos(\Tool:=tool0 \WObj:=wobj0));
        j := CalcJointT(p, tool0);
        q := CalcRobT(j, tool0);
        TPWrite place(q.trans) + " " + turn(q.rot);
        TPWrite ValToStr(Round(j.robax.rax_5 \Dec:=3));
        MoveAbsJ home, v1000, fine, tool0;
        MoveJ Offs(p, 3000, 0, 0), v200, fine, tool0;
        j := CalcJointT(Offs(p, 3000, 0, 0), tool0 \ErrorNumber:=n);
        IF n = ERR_OUTSIDE_REACH TPWrite "its number";
        displaced;
        MoveAbsJ home, v1000, fine, tool0;
        MoveL Offs(p, 0, 50, 0), v100, z10, tool0;
        WaitRob \ZeroSpeed;
        TPWrite place(CPos());
        MoveL p, v100, fine, tool0;
        CirPathMode \ObjectFrame;
        MoveC Offs(p, 0, 25, 25), Offs(p, 0, 50, 0), v100, fine, tool0;
        q := CRobT();
        TPWrite place(q.trans) + " " + turn(q.rot);
        StopMove;
        IF IsStopMoveAct(\FromMoveTask) TPWrite "own";
        IF IsStopMoveAct(\FromNonMoveTask) TPWrite "other";
        StartMove;
        IF NOT IsStopMoveAct(\FromMoveTask) TPWrite "free";
        configured;
    ERROR
        IF ERRNO = ERR_OUTSIDE_REACH TPWrite "outside reach";
        TRYNEXT;
    ENDPROC
    PROC displaced()
        MoveAbsJ home, v1000, fine, tool0;
        PDispSet [[0,50,0],[1,0,0,0]];
        MoveL p, v200, fine, tool0;
        TPWrite place(CPos());
        q := ORobT(p);
        TPWrite ValToStr(Round(q.trans.y \Dec:=3));
        MoveAbsJ home, v1000, fine, tool0;
        PDispOff;
        TPWrite place(CPos());
        PDispOn \ExeP:=Offs(p, 0, 30, 0), p, tool0;
        PDispOn \ExeP:=Offs(p, 0, 0, 20), p, tool0;
        MoveL p, v200, fine, tool0;
        PDispOff;
        TPWrite place(CPos());
    ENDPROC
    PROC configured()
        MoveAbsJ turned, v1000, fine, tool0;
        q := CRobT();
        q.robconf := [0,-2,2,1];
        MoveJ q, v500, fine, tool0;
        fourth;
        ConfJ \Off;
        q.robconf := [0,0,0,0];
        MoveJ q, v500, fine, tool0;
        fourth;
        ConfJ \On;
        MoveJ q, v500, fine, tool0;
        fourth;
    ENDPROC
    PROC fourth()
        j := CJointT();
        TPWrite ValToStr(Round(j.robax.rax_4));
    ENDPROC
    FUNC string place(pos here)
        RETURN ValToStr(rounded(here));
    ENDFUNC
    FUNC pos rounded(pos here)
        here := [Round(here.x \Dec:=3),Round(here.y \Dec:=3),Round(here.z \Dec:=3)];
        RETURN here;
    ENDFUNC
    FUNC string turn(orient here)
        here := [Round(here.q1 \Dec:=6),Round(here.q2 \Dec:=6),Round(here.q3 \Dec:=6),Round(here.q4 \Dec:=6)];
        RETURN ValToStr(here);
    ENDFUNC
ENDMODULE
