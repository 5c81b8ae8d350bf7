! rule: intnum is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR intnum a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
