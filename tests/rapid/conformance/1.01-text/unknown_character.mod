! rule: a character without meaning
! source: [K §2.8]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1 # 2;  ! -> RG204
    ENDPROC
ENDMODULE
