! rule: arguments of DropWObj
! source: [manual] 3HAC050917
MODULE Demo
    PERS wobjdata p_wobjdata;
    PROC main()
        DropWObj p_wobjdata;
        DropWObj;  ! -> RG311?
        DropWObj p_wobjdata \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
