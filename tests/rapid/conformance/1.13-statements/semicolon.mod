! rule: simple statements end with ;
! source: [K §4.1]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1
        b := 2;  ! -> RG201
    ENDPROC
ENDMODULE
