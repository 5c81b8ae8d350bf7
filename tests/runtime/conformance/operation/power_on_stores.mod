MODULE power_on_stores
    ! source: [code] CAB_EXEC_HOOKS: what POWER_ON stored is there at START
    ! hook: power_on POWER_ON T_ROB1
    ! do: run 1, start, run 1
    ! expect: 5
    VAR num v := 0;
    PROC power_on()
        v := 5;
    ENDPROC
    PROC main()
        TPWrite ValToStr(v);
    ENDPROC
ENDMODULE
