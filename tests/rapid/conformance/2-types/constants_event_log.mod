! rule: named values: types of events
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR errtype e;
    PROC main()
        e := TYPE_ALL;
        e := TYPE_STATE;
        e := TYPE_WARN;
        e := TYPE_ERR;
        e := TYPE_INFO;  ! -> RG302
    ENDPROC
ENDMODULE
