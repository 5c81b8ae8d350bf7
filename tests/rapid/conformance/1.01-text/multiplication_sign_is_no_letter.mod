! rule: the signs × and ÷ are no letters
! source: [K §2.1]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a×b := 1;  ! -> RG204
    ENDPROC
ENDMODULE
