! rule: CASE values have the type of the subject
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
        CASE "1":  ! -> RG307
        ENDTEST
    ENDPROC
ENDMODULE
