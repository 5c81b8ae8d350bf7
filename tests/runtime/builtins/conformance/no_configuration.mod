MODULE no_configuration
    ! source: [manual 3HAC050917 CalcJointT] ERR_ROBLIMIT: an axis would be outside its range; \ErrorNumber
    ! robot: irb120
    ! case:
    ! expect: handled TRUE FALSE
    ! expect: TRUE FALSE
    ! case: no_configuration=reach
    ! expect: handled FALSE TRUE
    ! expect: FALSE TRUE
    ! case: no_configuration=stop
    ! fault: 50080 18
    PROC main()
        VAR robtarget p;
        VAR jointtarget j;
        VAR errnum number;
        p := CRobT(\Tool:=tool0);
        p.robconf := [3,0,0,0];
        j := CalcJointT(p, tool0);
        j := CalcJointT(p, tool0 \ErrorNumber:=number);
        TPWrite ValToStr(number = ERR_ROBLIMIT) + " " + ValToStr(number = ERR_OUTSIDE_REACH);
    ERROR
        TPWrite "handled " + ValToStr(ERRNO = ERR_ROBLIMIT) + " " + ValToStr(ERRNO = ERR_OUTSIDE_REACH);
        TRYNEXT;
    ENDPROC
ENDMODULE
