! rule: a parameter counts as a datum of its routine
! source: [K §5.2]
MODULE Demo
    PROC main()
        p 1;
    ENDPROC
    PROC p(num a)
        VAR num a;  ! -> RG305
        TPWrite "" \Num:=a;
    ENDPROC
ENDMODULE
