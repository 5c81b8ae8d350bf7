! rule: what a program declares hides the name of an option
! source: [K §2.12, 2.20]
! given: system
MODULE Demo
    VAR num n;
    VAR num toolno;
    PROC main()
        toolno := 1;
        n := toolno;
        Calibrate 1;
        Calibrate;  ! -> RG311
    ENDPROC
    PROC Calibrate(num a)
        TPWrite "a" \Num:=a;
    ENDPROC
ENDMODULE
