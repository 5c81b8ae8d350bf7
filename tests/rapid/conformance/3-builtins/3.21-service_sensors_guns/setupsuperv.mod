! rule: arguments of SetupSuperv
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PROC main()
        SetupSuperv v_signaldi, v_num, v_num;
        SetupSuperv v_signaldi, v_num, v_num \ErrIndSig:=v_signaldo;
        SetupSuperv;  ! -> RG311?
    ENDPROC
ENDMODULE
