! rule: named values of options are not unknown
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := AW_WELD_ERR;
        n := NO_SUCH_ERR;  ! -> RG302
    ENDPROC
ENDMODULE
