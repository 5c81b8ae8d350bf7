! rule: a comment starts with ! and ends with the line
! source: [K §2.10]
MODULE Demo
    VAR num a;
    VAR num b;
    PROC main()
        a := 1; ! a := ;;; ENDPROC
        ! IF THEN
    ENDPROC
ENDMODULE
