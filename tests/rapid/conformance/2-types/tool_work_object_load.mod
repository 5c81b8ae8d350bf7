! rule: tool0, wobj0 and load0
! source: [code] abb_motion_program_exec
MODULE Demo
    VAR tooldata t;
    VAR wobjdata w;
    VAR loaddata l;
    PROC main()
        t := tool0;
        w := wobj0;
        l := load0;
        l := tool0;  ! -> RG307
    ENDPROC
ENDMODULE
