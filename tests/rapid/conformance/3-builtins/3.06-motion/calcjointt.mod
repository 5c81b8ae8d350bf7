! rule: arguments of CalcJointT
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    PERS tooldata p_tooldata;
    VAR jointtarget r_jointtarget;
    PERS wobjdata p_wobjdata;
    VAR errnum v_errnum;
    PROC main()
        r_jointtarget := CalcJointT(v_robtarget, p_tooldata);
        r_jointtarget := CalcJointT(\UseCurWObjPos, v_robtarget, p_tooldata \WObj:=p_wobjdata \ErrorNumber:=v_errnum);
        r_jointtarget := CalcJointT(v_robtarget);  ! -> RG311
        r_jointtarget := CalcJointT(v_robtarget, p_tooldata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
