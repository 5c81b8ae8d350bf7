! rule: buttondata is num
! source: [manual] 3HAC050917
MODULE Demo
    VAR buttondata a;
    VAR num n;
    PROC main()
        a := n;
        n := a;
        a := "x";  ! -> RG307
    ENDPROC
ENDMODULE
