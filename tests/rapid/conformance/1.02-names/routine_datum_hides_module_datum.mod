! rule: routine data hide module data
! source: [K §2.20]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        VAR string a;
        a := "x";
        TPWrite a;
        b := 1;
    ENDPROC
ENDMODULE
