! rule: arguments of STIndGunReset
! source: [manual] 3HAC050917
MODULE Demo
    VAR string v_string;
    PROC main()
        STIndGunReset v_string;
        STIndGunReset;  ! -> RG311?
    ENDPROC
ENDMODULE
