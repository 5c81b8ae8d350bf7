! rule: named values: dialogs
! source: [code] rapid-for-vim
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := resUnkwn;
        n := resOK;
        n := resAbort;
        n := resRetry;
        n := resIgnore;
        n := resCancel;
        n := resYes;
        n := resNo;
        n := btnNone;
        n := btnOK;
        n := btnAbrtRtryIgn;
        n := btnOKCancel;
        n := btnRetryCancel;
        n := btnYesNo;
        n := btnYesNoCancel;
        n := iconNone;
        n := iconInfo;
        n := iconWarning;
        n := iconError;
        n := no_such_value;  ! -> RG302
    ENDPROC
ENDMODULE
