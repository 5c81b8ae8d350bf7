! rule: named values: analog
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := AIO_ABOVE_HIGH;
        n := AIO_BELOW_HIGH;
        n := AIO_ABOVE_LOW;
        n := AIO_BELOW_LOW;
        n := AIO_BETWEEN;
        n := AIO_OUTSIDE;
        n := AIO_ALWAYS;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
