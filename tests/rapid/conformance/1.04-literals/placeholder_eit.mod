! rule: <EIT> stands for an ELSEIF branch
! source: [K §2.9, 4.13]
MODULE Demo
    VAR num a;
    PROC main()
        IF a = 1 THEN
            a := 2;
            <EIT>
        ENDIF
    ENDPROC
ENDMODULE
