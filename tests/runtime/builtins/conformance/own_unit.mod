MODULE own_unit
    ! source: [manual] GetServiceInfo; [code] RAPID of open EGM servers: ROB_ID is the robot of the task
    ! robot: irb120
    ! expect: ROB_1 TRUE
    PROC main()
        TPWrite GetMecUnitName(ROB_ID) + " " + ValToStr(IsMechUnitActive(ROB_ID));
    ENDPROC
ENDMODULE
