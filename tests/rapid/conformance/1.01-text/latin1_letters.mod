! rule: accented letters of Latin-1 belong to names
! source: [K §2.1]
MODULE Demo
    VAR num größe;
    VAR num été;
    PROC main()
        größe := 1;
        Été := größe;
    ENDPROC
ENDMODULE
