! rule: arguments of CPos
! source: [manual] 3HAC050917
MODULE Demo
    VAR pos r_pos;
    PERS tooldata p_tooldata;
    PERS wobjdata p_wobjdata;
    PROC main()
        r_pos := CPos();
        r_pos := CPos(\Tool:=p_tooldata \WObj:=p_wobjdata);
        r_pos := CPos(1);  ! -> RG311
        r_pos := CPos(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
