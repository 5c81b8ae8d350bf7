! rule: arguments of SoftDeact
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SoftDeact;
        SoftDeact \Ramp:=1;
        SoftDeact 1;  ! -> RG311
        SoftDeact \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
