! rule: named values: inttypes
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := USINT;
        n := UINT;
        n := UDINT;
        n := ULINT;
        n := SINT;
        n := INT;
        n := DINT;
        n := LINT;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
