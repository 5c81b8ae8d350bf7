! rule: arguments of TPShow
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPShow 1;
        TPShow;  ! -> RG311?
        TPShow 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
