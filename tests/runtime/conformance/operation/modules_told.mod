MODULE modules_told
    ! source: nobody tells of which modules; ModExist; a switch
    ! robot: irb120
    ! case: modules_told=true
    ! do: start, run 1
    ! expect: TRUE
    ! expect: FALSE
    ! case: modules_told=false
    ! do: start, run 1
    ! expect: FALSE
    ! expect: FALSE
    PROC main()
        TPWrite ValToStr(ModExist("modules_told"));
        TPWrite ValToStr(ModExist("nothing"));
    ENDPROC
ENDMODULE
