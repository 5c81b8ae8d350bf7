! rule: functions of options are not unknown
! source: [manual] 3HAC050917
! given: system
MODULE Demo
    VAR num n;
    PROC main()
        n := ProgMemFree();
        n := NoSuchOption();  ! -> RG301
    ENDPROC
ENDMODULE
