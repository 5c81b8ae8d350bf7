! rule: arguments of UIShow
! source: [manual] 3HAC050917
MODULE Demo
    PERS uishownum p_uishownum;
    VAR num v_num;
    PROC main()
        UIShow "x", "x";
        UIShow "x", "x" \InitCmd:="x" \InstanceId:=p_uishownum \Status:=v_num \NoCloseBtn;
        UIShow "x";  ! -> RG311
        UIShow "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
