! rule: arguments of RemoveAllCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        RemoveAllCyclicBool;
        RemoveAllCyclicBool \AllTasks;
        RemoveAllCyclicBool \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
