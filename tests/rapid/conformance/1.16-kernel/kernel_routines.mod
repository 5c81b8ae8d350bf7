! rule: the routines of the language itself
! source: [K §11]
MODULE Demo
    VAR intnum i;
    VAR num a;
    VAR bool b;
    VAR num v{3};
    PROC main()
        Break;
        IWatch i;
        ISleep i;
        a := Dim(v, 1);
        b := IsPers(a) OR IsVar(a);
        p \x:=1;
    ENDPROC
    PROC p(\num x)
        IF Present(x) TPErase;
    ENDPROC
ENDMODULE
