! rule: predefined speeds
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR speeddata s;
    PROC main()
        s := v5;
        s := v10;
        s := v20;
        s := v30;
        s := v40;
        s := v50;
        s := v60;
        s := v80;
        s := v100;
        s := v150;
        s := v200;
        s := v300;
        s := v400;
        s := v500;
        s := v600;
        s := v800;
        s := v1000;
        s := v1500;
        s := v2000;
        s := v2500;
        s := v3000;
        s := v4000;
        s := v5000;
        s := v6000;
        s := v7000;
        s := vmax;
        s := 1;  ! -> RG307
    ENDPROC
ENDMODULE
