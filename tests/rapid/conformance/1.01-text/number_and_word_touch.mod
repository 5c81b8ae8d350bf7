! rule: a number ends before a reserved word that goes on with an expression or a statement
! source: [K §2.2] wants a blank; loaded: CommSF.sys of a welding cell, saved twelve times [code]
MODULE Demo
    VAR num a1TO;
    PROC main()
        IF a1TO = 1THEN  ! -> RG205?
            a1TO := 7DIV 2;  ! as the first: told once
        ENDIF
        FOR i FROM 1TO 3.5DO
            TPWrite "1TO";
        ENDFOR
    ENDPROC
ENDMODULE
