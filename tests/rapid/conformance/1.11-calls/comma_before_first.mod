! rule: no comma stands before the first argument
! source: [K §3.10, 4.5]
MODULE Demo
    VAR num a;
    PROC main()
        TPWrite , "x";  ! -> RG201
        a := Abs(, 1);  ! -> RG201
    ENDPROC
ENDMODULE
