! rule: arguments of STIndGun
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR string v_string;
    PROC main()
        STIndGun v_string, v_num;
        STIndGun;  ! -> RG311?
    ENDPROC
ENDMODULE
