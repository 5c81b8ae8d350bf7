! rule: arguments of FitCircle
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR pos v_pos;
    VAR pos v_pos_2{2};
    PROC main()
        FitCircle v_pos_2, v_pos, v_num, v_pos;
        FitCircle v_pos_2 \NumPoints:=v_num, v_pos, v_num, v_pos \RMS:=v_num \MaxErr:=v_num \IndexWorst:=v_num;
        FitCircle;  ! -> RG311?
    ENDPROC
ENDMODULE
