! rule: arguments of STIsClosed
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR num v_num;
    VAR string v_string;
    PROC main()
        result := STIsClosed(v_string);
        result := STIsClosed(v_string \RetThickness:=v_num);
        result := STIsClosed();  ! -> RG311
    ENDPROC
ENDMODULE
