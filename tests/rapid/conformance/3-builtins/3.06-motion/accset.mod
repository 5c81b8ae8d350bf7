! rule: arguments of AccSet
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        AccSet 1, 1;
        AccSet 1, 1 \FinePointRamp:=1;
        AccSet 1;  ! -> RG311
        AccSet 1, 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
