MODULE counting
    PERS num parts := 0;

    PROC main()
        WHILE TRUE DO
            WaitDI diPart, 1 \MaxTime:=30;
            parts := parts + 1;
            SetDO doTaken, 1;
            WaitDI diPart, 0;
            SetDO doTaken, 0;
        ENDWHILE
    ENDPROC
ENDMODULE
