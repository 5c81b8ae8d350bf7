! rule: arguments of PrxGetMaxRecordpos
! source: [manual] 3HAC050917
MODULE Demo
    VAR mecunit v_mecunit;
    VAR num result;
    PROC main()
        result := PrxGetMaxRecordpos(v_mecunit);
        result := PrxGetMaxRecordpos();  ! -> RG311
    ENDPROC
ENDMODULE
