MODULE calc_in_background
    ! source: [ABB] a library's background task computes positions without a robot of its own; a switch
    ! robot: irb120
    ! task: T_BACK back
    ! case: calc_in_background=true
    ! do: start, run 1
    ! expect: 30
    ! case: calc_in_background=false
    ! do: start, run 1
    ! expect: refused
    PROC main()
        WaitTime 0.5;
    ENDPROC
    PROC back()
        VAR robtarget there;
        VAR jointtarget again;
        there := CalcRobT([[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], tool0 \WObj:=wobj0);
        again := CalcJointT(there, tool0 \WObj:=wobj0);
        TPWrite ValToStr(again.robax.rax_5);
        Stop;
    ERROR
        IF ERRNO = ERR_NOT_MOVETASK TPWrite "refused";
        Stop;
    ENDPROC
ENDMODULE
