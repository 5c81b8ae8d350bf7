! rule: arguments of CJointT
! source: [manual] 3HAC050917
MODULE Demo
    VAR jointtarget r_jointtarget;
    VAR taskid v_taskid;
    PROC main()
        r_jointtarget := CJointT();
        r_jointtarget := CJointT(\TaskRef:=v_taskid);
        r_jointtarget := CJointT(\TaskName:="x");
        r_jointtarget := CJointT(1);  ! -> RG311
        r_jointtarget := CJointT(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
