! rule: arguments of IOBusStart
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        IOBusStart v_string;
        IOBusStart;  ! -> RG311?
    ENDPROC
ENDMODULE
