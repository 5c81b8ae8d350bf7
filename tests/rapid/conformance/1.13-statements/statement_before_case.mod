! rule: a TEST has CASEs only
! source: [K §4.17]
MODULE Demo
    VAR num a;
    PROC main()
        TEST a
            a := 1;  ! -> RG201
        CASE 1:
        ENDTEST
    ENDPROC
ENDMODULE
