MODULE behind_an_error
    ! source: [S4 overview 3-23] a step tries the faulty statement again; a step back goes before it
    ! do: step
    ! do: step
    ! at: error
    ! do: step back
    ! at: main n := 5;
    ! do: set z 2, step
    ! at: main n := n / z;
    ! do: step
    ! at: main TPWrite ValToStr(n);
    ! do: step
    ! expect: 2.5
    ! at: finished
    PERS num z := 0;
    PROC main()
        VAR num n;
        n := 5;
        n := n / z;
        TPWrite ValToStr(n);
    ENDPROC
ENDMODULE
