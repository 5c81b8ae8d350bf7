! rule: arguments of CalcRobT
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget v_jointtarget;
    PERS tooldata p_tooldata;
    VAR robtarget r_robtarget;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata);
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata \WObj:=p_wobjdata);
        r_robtarget := CalcRobT(v_jointtarget);  ! -> RG311
        r_robtarget := CalcRobT(v_jointtarget, p_tooldata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
